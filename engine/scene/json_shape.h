#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/math/linear_algebra.h"
#include "scene/json_tree.h"

namespace careen {

/// The allowed range of a number. All numbers of a scene lie within ±kLargestNumber, and positive ones above
/// kSmallestPositive, so that no product of a few of them overflows in the engine.
inline constexpr double kLargestNumber = 1e60;
inline constexpr double kSmallestPositive = 1e-60;
struct NumberRange {
  double min = -kLargestNumber;
  double max = kLargestNumber;
  const char* unit = "";           ///< "kg"; empty for a dimensionless number
  const char* plain = "a number";  ///< the range in words: "a number above 0"
};
constexpr NumberRange anyNumber(const char* unit = "") { return {.unit = unit}; }
constexpr NumberRange positiveNumber(const char* unit = "") {
  return {.min = kSmallestPositive, .unit = unit, .plain = "a number above 0"};
}
constexpr NumberRange nonNegativeNumber(const char* unit = "") {
  return {.min = 0, .unit = unit, .plain = "a number not below 0"};
}

inline constexpr NumberRange kUnitRange = {.min = 0, .max = 1, .plain = "a number from 0 to 1"};

class JsonObject;

/// A JSON value with checked access by type. A value that does not fit is an InputError at its place, which
/// names the value by its label ("mass", "position[1]").
class JsonValue {
 public:
  JsonValue(const JsonTree& tree, const JsonNode& node, std::string label)
      : tree_(&tree), node_(&node), label_(std::move(label)) {}

  const JsonNode& node() const { return *node_; }
  bool is(JsonNode::Kind kind) const { return node_->kind == kind; }
  const std::string& label() const { return label_; }

  double number(const NumberRange& range) const;
  /// 1280 and 1280.0 are integers.
  int integer(int min, int max, const char* unit) const;
  bool boolean() const;
  const std::string& string(const std::string& expected) const;
  /// Index of the value in a list of known words.
  std::size_t word(const std::vector<std::string_view>& known, const std::string& what) const;
  /// [x, y, z]
  Vec3 vector(const NumberRange& range) const;
  /// [x, y, z], not all 0, normalised to a unit vector.
  Vec3 direction() const;
  /// `size` elements; any number of elements if `size` is absent.
  std::vector<JsonValue> elements(const std::string& expected, std::optional<std::size_t> size = {}) const;
  /// The values of an object with any keys.
  std::vector<JsonValue> members() const;
  /// An object with no other keys than these.
  JsonObject object(std::initializer_list<std::string_view> keys) const;

  /// "found <this> for <label>, expected <expected>"
  [[noreturn]] void fail(const std::string& expected) const;
  /// The same, with a description of what was found in place of the value itself.
  [[noreturn]] void failAs(const std::string& found, const std::string& expected) const;

 private:
  const JsonTree* tree_;
  const JsonNode* node_;
  std::string label_;
};

/// An object whose keys are all known.
class JsonObject {
 public:
  JsonObject(const JsonTree& tree, const JsonNode& node, std::string label)
      : tree_(&tree), node_(&node), label_(std::move(label)) {}

  std::optional<JsonValue> find(std::string_view key) const;
  JsonValue require(std::string_view key) const;
  bool has(std::string_view key) const { return node_->find(key) != nullptr; }

  double number(std::string_view key, const NumberRange& range, double whenAbsent) const;
  /// Its "name", which may be written to CSV files unescaped.
  std::string name(const std::string& whenAbsent) const;
  Vec3 vector(std::string_view key, const NumberRange& range) const;  ///< zero when absent

  /// "found <what> in <label>, expected <expected>", at the object
  [[noreturn]] void fail(const std::string& what, const std::string& expected) const;

 private:
  const JsonTree* tree_;
  const JsonNode* node_;
  std::string label_;
};

/// The known word most similar to `word`, if one is close enough.
std::optional<std::string_view> nearest(std::string_view word, const std::vector<std::string_view>& known);

}  // namespace careen
