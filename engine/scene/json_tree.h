#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace careen {

/// A JSON value with its position in the file.
struct JsonNode {
  enum class Kind { kNull, kBoolean, kNumber, kString, kArray, kObject };

  Kind kind = Kind::kNull;
  std::size_t offset = 0;  ///< of its first byte
  std::string key;         ///< if it is a member of an object, else empty
  std::size_t keyOffset = 0;
  bool boolean = false;
  double number = 0;
  std::string text;                ///< the characters of a string; a number as written
  std::vector<JsonNode> children;  ///< elements or members, in file order

  /// The member with this name, or null.
  const JsonNode* find(std::string_view name) const;
};

/// A JSON text with comments (// and /* */), parsed into nodes. Keys must be unique, numbers finite, nesting
/// at most 64 deep; otherwise InputError "file:line:column: found …, expected …". Lines and columns count
/// from 1, columns in characters. Time is linear in the text's length, memory at most 256 bytes for each of
/// its bytes (an array of numbers of one digit).
class JsonTree {
 public:
  /// `name` is the file's name in messages.
  JsonTree(std::string text, std::string name);

  const JsonNode& root() const { return root_; }
  const std::string& text() const { return text_; }
  const std::string& name() const { return name_; }

  /// "3:14"
  std::string place(std::size_t offset) const;
  /// Throws the InputError for that place.
  [[noreturn]] void fail(std::size_t offset, const std::string& found, const std::string& expected) const;

 private:
  std::string text_;
  std::string name_;
  JsonNode root_;
};

/// A place in a text as "3:14": line and column, which count from 1; columns in characters.
std::string placeIn(std::string_view text, std::size_t offset);
/// Description of a value for messages: "null", "true", "-1.5", "\"crate\"", "an array of 2", "an object".
std::string describe(const JsonNode& node);
/// Text in quotes for a message: cut if long, control characters replaced.
std::string inQuotes(std::string_view text);

}  // namespace careen
