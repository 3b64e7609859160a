#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace careen {

/// A JSON value that knows where in the file it stands.
struct JsonNode {
  enum class Kind { kNull, kBoolean, kNumber, kString, kArray, kObject };

  Kind kind = Kind::kNull;
  std::size_t offset = 0;  ///< of its first byte
  std::string key;         ///< if it is a member of an object
  std::size_t keyOffset = 0;
  bool boolean = false;
  double number = 0;
  std::string text;                ///< a string's characters; a number as it is written
  std::vector<JsonNode> children;  ///< elements or members, in the file's order

  /// The member of that name, or null.
  const JsonNode* find(std::string_view name) const;
};

/// A JSON text with comments (// and /* */), read into nodes. Keys are unique, numbers finite, nesting is at
/// most 64 deep; anything else is an InputError "file:line:column: found …, expected …". Lines and columns
/// count from 1, columns in characters.
class JsonTree {
 public:
  /// `name` stands for the file in messages.
  JsonTree(std::string text, std::string name);

  const JsonNode& root() const { return root_; }
  const std::string& text() const { return text_; }

  /// "3:14"
  std::string place(std::size_t offset) const;
  /// Throws the InputError for that place.
  [[noreturn]] void fail(std::size_t offset, const std::string& found, const std::string& expected) const;

 private:
  std::string text_;
  std::string name_;
  JsonNode root_;
};

/// What a message says it found: "null", "true", "-1.5", "\"crate\"", "an array of 2", "an object".
std::string describe(const JsonNode& node);
/// In quotes, cut where it is long, control characters replaced: fit for a message.
std::string inQuotes(std::string_view text);

}  // namespace careen
