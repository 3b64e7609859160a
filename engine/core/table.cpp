#include "core/table.h"

#include <algorithm>
#include <cmath>

#include "core/brief.h"
#include "core/characters.h"

namespace careen {
namespace {

bool isFormula(std::string_view text) {
  if (text.empty()) {
    return false;
  }
  const char first = text[0];
  const bool calls = text.find_first_of("(|!") != std::string_view::npos;
  return first == '=' || first == '@' || static_cast<unsigned char>(first) < 0x20 ||
         ((first == '+' || first == '-') && calls);
}

std::string markdownCell(const TableCell& cell) {
  std::string text;
  for (const char c : onOneLine(cell.text)) {
    text += c == '|' ? "\\|" : std::string(1, c);
  }
  return cell.isStrong ? "**" + text + "**" : text;
}

std::string htmlCell(const TableCell& cell, const std::string& element) {
  std::string text = escapedForMarkup(cell.text);
  if (!cell.section.empty()) {
    text = "<a href=\"#" + escapedForMarkup(cell.section) + "\">" + text + "</a>";
  }
  if (!cell.replaced.empty()) {
    text = "<del>" + escapedForMarkup(cell.replaced) + "</del> <ins>" + text + "</ins>";
  }
  return "<" + element + (cell.attributes.empty() ? "" : " ") + cell.attributes + ">" + text + "</" +
         element + ">";
}

}  // namespace

std::string Table::csv() const {
  std::string text;
  const auto addLine = [&text](const std::vector<TableCell>& cells) {
    CsvRow row;
    for (const TableCell& cell : cells) {
      row.add(onOneLine(cell.text));
    }
    text += row.line();
  };
  addLine({head.begin(), head.end()});
  std::for_each(rows.begin(), rows.end(), addLine);
  return text;
}

std::string Table::markdown() const {
  std::string text;
  const auto addLine = [&text](const std::vector<TableCell>& cells) {
    text += "|";
    for (const TableCell& cell : cells) {
      text.append(" ").append(markdownCell(cell)).append(" |");
    }
    text += "\n";
  };
  addLine({head.begin(), head.end()});
  text += "|";
  for (std::size_t i = 0; i < head.size(); ++i) {
    text += "---|";
  }
  text += "\n";
  std::for_each(rows.begin(), rows.end(), addLine);
  return text;
}

std::string Table::html(const std::string& kind) const {
  std::string text = kind.empty() ? "<table>" : "<table class=\"" + kind + "\">\n";
  text += "<tr>";
  for (const std::string& name : head) {
    text += htmlCell(name, "th");
  }
  text += "</tr>\n";
  for (const std::vector<TableCell>& row : rows) {
    text += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) {
      text += htmlCell(row[i], i == 0 ? "th" : "td");
    }
    text += "</tr>\n";
  }
  return text + "</table>\n";
}

void CsvRow::separate() {
  row_ += isFirst_ ? "" : ",";
  isFirst_ = false;
}

CsvRow& CsvRow::add(std::string_view text) {
  separate();
  row_ += csvCell(text);
  return *this;
}

CsvRow& CsvRow::add(double value) {
  constexpr int kDigits = 17;
  separate();
  row_ += std::isnan(value) ? "nan" : brief(value, kDigits);
  return *this;
}

std::string csvCell(std::string_view text) {
  std::string cell = isFormula(text) ? "'" : "";
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    return cell.append(text);
  }
  for (const char c : text) {
    cell += c == '"' ? "\"\"" : std::string(1, c);
  }
  return '"' + cell + '"';
}

std::string onOneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

}  // namespace careen
