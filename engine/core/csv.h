#pragma once

#include <string>
#include <string_view>

namespace careen {

/// A name or message as one cell of a table (CSV, RFC 4180): in quotes where it holds a comma, a quote or a
/// line end. A text that a spreadsheet would run as a formula gets an apostrophe before it: what begins with
/// = or @ or a control character, and what begins with + or - and calls something.
std::string csvCell(std::string_view text);

}  // namespace careen
