#pragma once

#include <string>
#include <string_view>

namespace careen {

/// The characters of a text; U+FFFD replaces invalid bytes.
std::u32string charactersOf(std::string_view utf8);

/// A character in UTF-8, one to four bytes.
std::string utf8Of(char32_t character);

/// A text as content or attribute of XML and HTML: markup characters are escaped, and U+FFFD replaces what is
/// not allowed there: control characters and invalid UTF-8. Tabs and line ends stay.
std::string escapedForMarkup(std::string_view utf8);

}  // namespace careen
