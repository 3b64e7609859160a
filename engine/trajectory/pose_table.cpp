#include "trajectory/pose_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "core/brief.h"
#include "core/error.h"
#include "core/names.h"
#include "trajectory/pose_arrays.h"
#include "trajectory/zip_archive.h"

namespace careen {
namespace {

constexpr double kLargestNumber = 1e60;  // as in scenes: no product of a few of them overflows
constexpr std::size_t kShown = 40;       // [bytes] of a cell in a message
constexpr std::size_t kTime = 0;
constexpr std::size_t kBox = 1;
constexpr std::size_t kPosition = 2;
constexpr std::size_t kQuaternion = 5;
constexpr std::size_t kVelocity = 9;
constexpr std::size_t kAngularVelocity = 12;

std::string inQuotes(std::string_view text) {
  return std::string("'").append(text.substr(0, kShown)).append(text.size() > kShown ? "…'" : "'");
}

std::string_view trimmed(std::string_view text) {
  const auto isBlank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && isBlank(text.front())) {
    text.remove_prefix(1);
  }
  while (!text.empty() && isBlank(text.back())) {
    text.remove_suffix(1);
  }
  return text;
}

Vec3 vectorAt(const std::array<double, kPoseColumns.size()>& numbers, std::size_t first) {
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

/// The cells of one line of CSV.
class Cells {
 public:
  // nullopt if a quote is not closed.
  static std::optional<std::vector<std::string>> of(std::string_view line) {
    std::vector<std::string> cells(1);
    bool isQuoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const char c = line[i];
      if (isQuoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
        cells.back() += '"';
        ++i;
      } else if (c == '"') {
        isQuoted = !isQuoted;
      } else if (c == ',' && !isQuoted) {
        cells.emplace_back();
      } else {
        cells.back() += c;
      }
    }
    if (isQuoted) {
      return std::nullopt;
    }
    return cells;
  }
};

// Splits a text into lines, which end in \n or \r\n.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (rest_.starts_with(kByteOrderMark)) {
      rest_.remove_prefix(kByteOrderMark.size());
    }
  }
  bool next(std::string_view& line) {
    if (rest_.empty()) {
      return false;
    }
    const std::size_t end = rest_.find('\n');
    line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (line.ends_with('\r')) {
      line.remove_suffix(1);
    }
    ++number_;
    return true;
  }
  std::size_t number() const { return number_; }  ///< of the last line, from 1
  bool atEnd() const { return rest_.empty(); }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

std::vector<std::string> namesIn(std::string_view header) {
  std::vector<std::string> names = Cells::of(header).value_or(std::vector<std::string>{std::string(header)});
  for (std::string& name : names) {
    name = std::string(trimmed(name));
  }
  return names;
}

std::optional<double> numberIn(std::string_view cell) {
  std::string_view text = trimmed(cell);
  if (text.starts_with('+')) {
    text.remove_prefix(1);
  }
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || text.empty() || error == std::errc::invalid_argument) {
    return std::nullopt;
  }
  // What is too small or too large for a double: 0 would be a guess for the latter.
  return error == std::errc::result_out_of_range ? std::optional<double>() : value;
}

PoseTable readCsv(const std::string& bytes, const std::string& name) {
  Lines lines(bytes);
  std::string_view line;
  if (!lines.next(line)) {
    throw InputError(name + ": is empty, expected a table of poses");
  }
  const std::string beginning = name + ":";
  const std::vector<std::string> names = namesIn(line);
  PoseTable table;
  table.name = name;
  table.placeFormat = "line";
  PoseTableBuilder builder(std::move(table), names, beginning + "1: ");
  std::array<double, kPoseColumns.size()> numbers{};
  while (lines.next(line)) {
    if (trimmed(line).empty()) {
      continue;
    }
    const std::string where = beginning + std::to_string(lines.number()) + ": ";
    const std::optional<std::vector<std::string>> cells = Cells::of(line);
    if (!cells || cells->size() != names.size()) {
      throw InputError(where + "found " +
                       (cells ? std::to_string(cells->size()) + " cells" : std::string("an open quote")) +
                       ", expected " + std::to_string(names.size()) + ", as the first line has" +
                       (lines.atEnd() ? "; the file may be cut short" : ""));
    }
    std::string_view box;
    for (std::size_t k = 0; k < kPoseColumns.size(); ++k) {
      const std::size_t index = builder.indexOf(kPoseColumns[k]);
      if (index == PoseTableBuilder::kAbsent) {
        continue;
      }
      const std::string& cell = (*cells)[index];
      if (k == kBox) {
        box = trimmed(cell);
        continue;
      }
      const std::optional<double> number = numberIn(cell);
      if (!number) {
        throw InputError(where + "found " + inQuotes(cell) + " for " + std::string(kPoseColumns[k]) +
                         ", expected a number");
      }
      numbers[k] = *number;
    }
    builder.add(lines.number(), numbers, box);
  }
  return builder.finish();
}

}  // namespace

std::array<double, kPoseColumns.size() - 2> PoseRow::numbers() const {
  const Quat& q = worldFromBody;
  return {position.x(),
          position.y(),
          position.z(),
          q.w(),
          q.x(),
          q.y(),
          q.z(),
          velocity.x(),
          velocity.y(),
          velocity.z(),
          angularVelocity.x(),
          angularVelocity.y(),
          angularVelocity.z()};
}

double PoseTable::firstTime() const {
  return std::min_element(rows.begin(), rows.end(),
                          [](const PoseRow& a, const PoseRow& b) { return a.time < b.time; })
      ->time;
}

void PoseTable::beginAtZero() {
  const double first = firstTime();
  for (PoseRow& row : rows) {
    row.time -= first;
  }
}

void PoseTable::fail(const PoseRow& row, const std::string& found, const std::string& expected) const {
  std::string text = name;
  text.append(placeFormat == "line" ? ":" : ": row ").append(std::to_string(row.place));
  throw InputError(text.append(": found ").append(found).append(", expected ").append(expected));
}

PoseTableBuilder::PoseTableBuilder(PoseTable table, const std::vector<std::string>& columns,
                                   const std::string& where)
    : table_(std::move(table)) {
  places_.fill(kAbsent);
  for (std::size_t index = 0; index < columns.size(); ++index) {
    const auto* const known = std::find(kPoseColumns.begin(), kPoseColumns.end(), columns[index]);
    if (known == kPoseColumns.end()) {
      throw InputError(where + "found the unknown column " + inQuotes(columns[index]) +
                       ", expected columns among " + listed(kPoseColumns));
    }
    std::size_t& place = places_.at(static_cast<std::size_t>(known - kPoseColumns.begin()));
    if (place != kAbsent) {
      throw InputError(where + "found the column " + columns[index] + " twice, expected it once");
    }
    place = index;
  }
  const auto has = [this](std::size_t k) { return places_.at(k) != kAbsent; };
  const auto require = [&](std::size_t k, const char* why) {
    if (!has(k)) {
      throw InputError(where + "found no column " + std::string(kPoseColumns.at(k)) +
                       ", expected it: " + why);
    }
  };
  require(kTime, "each row has its time [s]");
  for (std::size_t k = kPosition; k < kVelocity; ++k) {
    require(k, "a pose is x, y, z, qw, qx, qy, qz");
  }
  const auto allOrNone = [&](std::size_t first, const char* why) {
    const bool any = has(first) || has(first + 1) || has(first + 2);
    for (std::size_t k = first; any && k < first + 3; ++k) {
      require(k, why);
    }
    return any;
  };
  table_.hasVelocities = allOrNone(kVelocity, "a velocity has three components, or is left out");
  table_.hasAngularVelocities =
      allOrNone(kAngularVelocity, "an angular velocity has three components, or is left out");
  table_.hasBoxes = has(kBox);
}

std::size_t PoseTableBuilder::indexOf(std::string_view column) const {
  const auto* const known = std::find(kPoseColumns.begin(), kPoseColumns.end(), column);
  return places_.at(static_cast<std::size_t>(known - kPoseColumns.begin()));
}

std::size_t PoseTableBuilder::boxNamed(std::string_view name) {
  // Rows of a box follow each other, or the boxes repeat in one order: hardly ever is there a search.
  for (std::size_t guess = lastBox_; guess < std::min(lastBox_ + 2, table_.boxes.size()); ++guess) {
    if (table_.boxes[guess] == name) {
      return guess;
    }
  }
  const auto [known, isNew] = indices_.try_emplace(std::string(name), table_.boxes.size());
  if (isNew) {
    table_.boxes.emplace_back(name);
    lastTimes_.push_back(-1);
  }
  return known->second;
}

void PoseTableBuilder::add(std::size_t place, const std::array<double, kPoseColumns.size()>& numbers,
                           std::string_view box) {
  PoseRow row;
  row.place = place;
  for (std::size_t k = 0; k < kPoseColumns.size(); ++k) {
    if (k != kBox && places_.at(k) != kAbsent &&
        !(std::isfinite(numbers[k]) && std::abs(numbers[k]) <= kLargestNumber)) {
      table_.fail(row, brief(numbers[k]) + " for " + std::string(kPoseColumns[k]),
                  "a finite number within 1e60");
    }
  }
  row.time = numbers[kTime];
  if (row.time < 0) {
    table_.fail(row, "time " + brief(row.time), "0 s or later");
  }
  row.box = boxNamed(box);
  lastBox_ = row.box;
  double& last = lastTimes_[row.box];
  if (row.time <= last) {
    table_.fail(row, "time " + inFull(row.time) + " after " + inFull(last) + nameShown(row),
                "ascending times of each box");
  }
  last = row.time;
  row.position = vectorAt(numbers, kPosition);
  const Quat q(numbers[kQuaternion], numbers[kQuaternion + 1], numbers[kQuaternion + 2],
               numbers[kQuaternion + 3]);
  const double error = q.coeffs().cwiseAbs().maxCoeff() <= 2 ? std::abs(q.norm() - 1) : 2.0;
  if (!(error <= kMostQuaternionError)) {
    table_.fail(row,
                "the quaternion (" + brief(q.w()) + ", " + brief(q.x()) + ", " + brief(q.y()) + ", " +
                    brief(q.z()) + ")" + nameShown(row),
                "one of length 1, to 0.001");
  }
  table_.quaternionError = std::max(table_.quaternionError, error);
  row.worldFromBody = q.normalized();
  if (table_.hasVelocities) {
    row.velocity = vectorAt(numbers, kVelocity);
  }
  if (table_.hasAngularVelocities) {
    row.angularVelocity = vectorAt(numbers, kAngularVelocity);
  }
  table_.rows.push_back(row);
}

std::string PoseTableBuilder::nameShown(const PoseRow& row) const {
  return table_.hasBoxes ? " for box " + inQuotes(table_.boxes[row.box]) : "";
}

PoseTable PoseTableBuilder::finish() {
  if (table_.rows.empty()) {
    throw InputError(table_.name + ": found no rows, expected poses");
  }
  return std::move(table_);
}

bool looksLikePoseTable(std::string_view bytes, std::string_view name) {
  if (looksLikeZip(bytes) || name.ends_with(".csv") || name.ends_with(".npz")) {
    return true;
  }
  constexpr std::size_t kLongestHeader = 1024;
  std::string_view line;
  Lines lines(bytes.substr(0, kLongestHeader));
  if (!lines.next(line) || line.find('{') != std::string_view::npos) {
    return false;
  }
  const std::vector<std::string> names = namesIn(line);
  return names.size() > 1 && std::find(names.begin(), names.end(), "time") != names.end();
}

PoseTable readPoseTable(const std::string& bytes, const std::string& name) {
  return looksLikeZip(bytes) || name.ends_with(".npz") ? readPoseArrays(bytes, name) : readCsv(bytes, name);
}

}  // namespace careen
