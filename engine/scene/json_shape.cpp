#include "scene/json_shape.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/names.h"

namespace careen {
namespace {

using Kind = JsonNode::Kind;

std::string withUnit(const std::string& text, const std::string& unit) {
  return unit.empty() ? text : text + " [" + unit + "]";
}

// The range in words where the bound is a natural one; the number where it is only a limit of careen.
std::string expectedNumber(const NumberRange& range, double found) {
  if (found > range.max && range.max == kLargestNumber) {
    return withUnit("a number of at most 1e60", range.unit);
  }
  if (found < range.min && range.min == -kLargestNumber) {
    return withUnit("a number of at least -1e60", range.unit);
  }
  if (found > 0 && found < range.min && range.min == kSmallestPositive) {
    return withUnit("a number of at least 1e-60", range.unit);
  }
  return withUnit(range.plain, range.unit);
}

// Levenshtein distance (edits of one letter), ignoring case.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = std::tolower(static_cast<unsigned char>(a[i - 1])) ==
                        std::tolower(static_cast<unsigned char>(b[j - 1]));
      const std::size_t replaced = diagonal + (same ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, replaced}));
    }
  }
  return row.back();
}

std::string oneOf(const std::vector<std::string_view>& known) {
  return known.size() == 1 ? std::string(known[0]) : "one of " + listed(known);
}

std::string member(const std::string& label, std::string_view key) {
  return label.empty() ? std::string(key) : label + "." + std::string(key);
}

std::string shown(const std::string& label) { return label.empty() ? "the scene" : label; }

}  // namespace

std::optional<std::string_view> nearest(std::string_view word, const std::vector<std::string_view>& known) {
  std::optional<std::string_view> best;
  std::size_t fewest = 2 + word.size() / 4;  // at this many edits the words are unrelated
  for (const std::string_view each : known) {
    if (each.size() < word.size() + fewest && word.size() < each.size() + fewest) {
      const std::size_t edits = editDistance(word, each);
      if (edits < fewest && edits < each.size()) {
        fewest = edits;
        best = each;
      }
    }
  }
  return best;
}

double JsonValue::number(const NumberRange& range) const {
  if (!is(Kind::kNumber)) {
    fail(withUnit(range.plain, range.unit));
  }
  const double value = node_->number;
  if (!(value >= range.min && value <= range.max)) {
    fail(expectedNumber(range, value));
  }
  return value;
}

int JsonValue::integer(int min, int max, const char* unit) const {
  const double value = node_->number;
  const bool isNoCount = min >= 0 && std::signbit(value);  // −0 is none to a schema
  if (!is(Kind::kNumber) || isNoCount || value < min || value > max || value != std::floor(value)) {
    fail(withUnit("a whole number from " + std::to_string(min) + " to " + std::to_string(max), unit));
  }
  return static_cast<int>(value);
}

bool JsonValue::boolean() const {
  if (!is(Kind::kBoolean)) {
    fail("true or false");
  }
  return node_->boolean;
}

const std::string& JsonValue::string(const std::string& expected) const {
  if (!is(Kind::kString)) {
    fail(expected);
  }
  return node_->text;
}

std::size_t JsonValue::word(const std::vector<std::string_view>& known, const std::string& what) const {
  const std::string& text = string("the name of a " + what);
  const auto at = std::find(known.begin(), known.end(), text);
  if (at == known.end()) {
    tree_->fail(node_->offset, "the unknown " + what + " " + inQuotes(text), oneOf(known));
  }
  return static_cast<std::size_t>(at - known.begin());
}

Vec3 JsonValue::vector(const NumberRange& range) const {
  const std::vector<JsonValue> parts = elements(withUnit("[x, y, z]", range.unit), 3);
  return {parts[0].number(range), parts[1].number(range), parts[2].number(range)};
}

Vec3 JsonValue::direction() const {
  const Vec3 value = vector(anyNumber());
  const double largest = value.cwiseAbs().maxCoeff();
  if (largest == 0) {
    failAs("a zero vector", "a direction");
  }
  return (value / largest).normalized();  // tiny components would square to 0
}

std::vector<JsonValue> JsonValue::elements(const std::string& expected,
                                           std::optional<std::size_t> size) const {
  if (!is(Kind::kArray) || (size && node_->children.size() != *size)) {
    fail(expected);
  }
  std::vector<JsonValue> values;
  for (const JsonNode& child : node_->children) {
    values.emplace_back(*tree_, child, label_ + "[" + std::to_string(values.size()) + "]");
  }
  return values;
}

std::vector<JsonValue> JsonValue::members() const {
  std::vector<JsonValue> members;
  for (const JsonNode& child : node_->children) {
    members.emplace_back(*tree_, child, label_ + "." + child.key);
  }
  return members;
}

JsonObject JsonValue::object(std::initializer_list<std::string_view> keys) const {
  if (!is(Kind::kObject)) {
    fail("an object");
  }
  for (const JsonNode& child : node_->children) {
    if (std::find(keys.begin(), keys.end(), child.key) == keys.end()) {
      const std::optional<std::string_view> meant = nearest(child.key, keys);
      tree_->fail(child.keyOffset, "the unknown key " + inQuotes(child.key) + " in " + shown(label_),
                  meant ? inQuotes(*meant) : oneOf(keys));
    }
  }
  return {*tree_, *node_, label_};
}

void JsonValue::fail(const std::string& expected) const { failAs(describe(*node_), expected); }

void JsonValue::failAs(const std::string& found, const std::string& expected) const {
  tree_->fail(node_->offset, found + " for " + shown(label_), expected);
}

std::optional<JsonValue> JsonObject::find(std::string_view key) const {
  const JsonNode* const child = node_->find(key);
  return child == nullptr ? std::nullopt : std::optional(JsonValue(*tree_, *child, member(label_, key)));
}

JsonValue JsonObject::require(std::string_view key) const {
  const std::optional<JsonValue> value = find(key);
  if (!value) {
    fail("no " + std::string(key), "that key");
  }
  return *value;
}

double JsonObject::number(std::string_view key, const NumberRange& range, double whenAbsent) const {
  const std::optional<JsonValue> value = find(key);
  return value ? value->number(range) : whenAbsent;
}

std::string JsonObject::name(const std::string& whenAbsent) const {
  const std::optional<JsonValue> value = find("name");
  if (!value) {
    return whenAbsent;
  }
  const std::string expected = "a name without comma, quote or control character";
  const std::string& name = value->string(expected);
  if (name.empty() || std::any_of(name.begin(), name.end(), [](char c) {
        return c == ',' || c == '"' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
      })) {
    value->fail(expected);
  }
  return name;
}

Vec3 JsonObject::vector(std::string_view key, const NumberRange& range) const {
  const std::optional<JsonValue> value = find(key);
  return value ? value->vector(range) : Vec3::Zero();
}

void JsonObject::fail(const std::string& what, const std::string& expected) const {
  tree_->fail(node_->offset, what + " in " + shown(label_), expected);
}

}  // namespace careen
