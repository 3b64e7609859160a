#pragma once

#include <cstddef>
#include <string_view>

namespace careen {

/// Some editors write it at the start of a file.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Walks a JSON text token by token, in step with a parser that does not report token positions. Relies on
/// the parser having accepted every token passed.
class JsonCursor {
 public:
  explicit JsonCursor(std::string_view text);

  /// The text between two tokens.
  struct Gap {
    std::size_t end = 0;    ///< offset of the next token, or of the limit
    char separator = '\0';  ///< the last comma or colon passed
  };
  /// Skips white space, comments, commas and colons, up to `limit`; does not move the cursor.
  Gap gap(std::size_t limit) const;
  /// Steps over the next token and returns its offset.
  std::size_t next();

 private:
  std::size_t endOfComment(std::size_t start) const;
  std::size_t endOfToken(std::size_t start) const;

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace careen
