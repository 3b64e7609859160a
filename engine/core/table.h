#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace careen {

/// A cell of a table. Texts are escaped as each format needs it.
struct TableCell {
  TableCell(std::string words) : text(std::move(words)) {}
  TableCell(const char* words) : text(words) {}
  TableCell(std::string words, std::string attribute)
      : text(std::move(words)), attributes(std::move(attribute)) {}

  std::string text;
  std::string attributes{};  ///< of its element in HTML, such as class="bad"
  std::string replaced{};    ///< text that stands before it in HTML, struck out
  std::string section{};     ///< of the page that it is a link to in HTML
  bool isStrong = false;     ///< in Markdown
};

/// A table in the formats that are for people, and in CSV.
struct Table {
  std::vector<std::string> head;
  std::vector<std::vector<TableCell>> rows{};

  /// Line ends in cells become blanks: many readers of tables take one line for one row.
  std::string csv() const;
  std::string markdown() const;
  /// The first cell of a row is its head. `kind`: the table's class.
  std::string html(const std::string& kind = "") const;
};

/// One line of a table in CSV that is too long to be kept.
class CsvRow {
 public:
  CsvRow& add(std::string_view text);
  /// With 17 digits, from which a double is read back as it was; nan without sign.
  CsvRow& add(double value);
  template <class Numbers>
  CsvRow& addAll(const Numbers& numbers) {
    for (const double number : numbers) {
      add(number);
    }
    return *this;
  }
  std::string line() const { return row_ + "\n"; }

 private:
  void separate();

  std::string row_;
  bool isFirst_ = true;
};

/// A name or message as one cell of a table (CSV, RFC 4180): in quotes where it holds a comma, a quote or a
/// line end. A text that a spreadsheet would run as a formula gets an apostrophe before it: what begins with
/// = or @ or a control character, and what begins with + or - and calls something.
std::string csvCell(std::string_view text);

/// With blanks for line ends.
std::string onOneLine(std::string text);

}  // namespace careen
