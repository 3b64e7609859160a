#pragma once

#include <string>
#include <string_view>

namespace careen {

/// Text of a part of report pages, a file of assets/compare, as embedded at build time; empty if there is
/// none of that name.
std::string_view embeddedPageFile(std::string_view name);

/// Text of a part of report pages: the file in $CAREEN_DATA if it is set and has one, else the embedded one.
/// MachineError if there is neither.
std::string pageFile(const std::string& name);

}  // namespace careen
