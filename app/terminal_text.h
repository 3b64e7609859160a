#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace careen {

/// Columns of the terminal that a file descriptor leads to; `usual` if it leads to none.
std::size_t terminalColumns(int descriptor, std::size_t usual);

/// Words in lines of at most `columns` letters, unless a word is longer; each line after the first begins
/// with `indent` blanks more than the text does.
std::string wrapped(std::string_view text, std::size_t columns, std::size_t indent = 0);

/// Markdown in lines of at most `columns` letters. A table that is wider becomes a list of its rows, each
/// cell after its column's head. What stands between ``` is left as it is.
std::string wrappedMarkdown(std::string_view page, std::size_t columns);

/// What --help prints: what a line tells of an option begins at a column of its own, and so do the lines
/// after it.
std::string wrappedOptions(std::string_view help, std::size_t columns);

/// Columns that a text on the standard output may have, at most 100; nothing where that is no terminal, for
/// there a text stays as it is.
std::optional<std::size_t> readingColumns();

/// Shows a text: on a terminal that it does not fit in, by $PAGER, or else `less`.
void showText(const std::string& text);

}  // namespace careen
