#pragma once

#include <string>
#include <string_view>

namespace careen {

/// The characters of a text; U+FFFD replaces invalid bytes.
std::u32string charactersOf(std::string_view utf8);

/// A character in UTF-8, one to four bytes.
std::string utf8Of(char32_t character);

/// With small letters for A to Z; others stay, whatever the locale.
std::string lowered(std::string_view text);

/// A text as content or attribute of XML and HTML: markup characters are escaped, and U+FFFD replaces what is
/// not allowed there: control characters and invalid UTF-8. Tabs and line ends stay.
std::string escapedForMarkup(std::string_view utf8);

/// A text for a terminal: what would steer it or change the order of letters is written as an escape, \x1b or
/// \u202e, and U+FFFD replaces invalid UTF-8. Tabs and line ends are escaped too in a name, which is one word
/// of a line; in a message they stay, and lines after the first are indented, so that none looks like another
/// message.
std::string printableName(std::string_view utf8);
std::string printableMessage(std::string_view utf8);

}  // namespace careen
