#include "scene/json_cursor.h"

#include <algorithm>

namespace careen {
namespace {

constexpr std::string_view kEndsOfLine = "\n\r";
constexpr std::string_view kEndsOfWord = " \t\n\r,:[]{}\"/";

}  // namespace

JsonCursor::JsonCursor(std::string_view text)
    : text_(text), at_(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0) {}

JsonCursor::Gap JsonCursor::gap(std::size_t limit) const {
  Gap gap{.end = at_};
  while (gap.end < std::min(limit, text_.size())) {
    const char c = text_[gap.end];
    if (c == '/') {
      const std::size_t end = endOfComment(gap.end);
      if (end == gap.end) {
        break;
      }
      gap.end = end;
    } else if (c == ',' || c == ':') {
      gap.separator = c;
      ++gap.end;
    } else if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
      ++gap.end;
    } else {
      break;
    }
  }
  return gap;
}

std::size_t JsonCursor::next() {
  const std::size_t start = gap(text_.size()).end;
  at_ = endOfToken(start);
  return start;
}

// Returns `start` if there is no complete comment.
std::size_t JsonCursor::endOfComment(std::size_t start) const {
  const std::string_view rest = text_.substr(start);
  if (rest.starts_with("//")) {
    return std::min(text_.find_first_of(kEndsOfLine, start), text_.size());
  }
  const std::size_t end = rest.starts_with("/*") ? text_.find("*/", start + 2) : std::string_view::npos;
  return end == std::string_view::npos ? start : end + 2;
}

std::size_t JsonCursor::endOfToken(std::size_t start) const {
  if (start >= text_.size()) {
    return text_.size();
  }
  if (text_[start] == '"') {
    std::size_t end = start + 1;
    while (end < text_.size() && text_[end] != '"') {
      end += text_[end] == '\\' ? 2 : 1;
    }
    return std::min(end + 1, text_.size());
  }
  return std::min(std::max(text_.find_first_of(kEndsOfWord, start), start + 1), text_.size());
}

}  // namespace careen
