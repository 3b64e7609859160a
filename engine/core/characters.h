#pragma once

#include <string>
#include <string_view>

namespace careen {

/// The characters of a text; U+FFFD in place of bytes that are none.
std::u32string charactersOf(std::string_view utf8);

/// A character in UTF-8, one to four bytes.
std::string utf8Of(char32_t character);

/// A text as content or attribute of XML and HTML: what has a meaning there is escaped, and what may not be
/// there at all, control characters and bytes that are no UTF-8, becomes U+FFFD. Tabs and ends of lines stay.
std::string escapedForMarkup(std::string_view utf8);

}  // namespace careen
