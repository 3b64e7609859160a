#pragma once

#include <string>
#include <string_view>

namespace careen {

/// Text of a file of assets/plots as embedded at build time; empty if there is none of that name.
std::string_view embeddedPlotFile(std::string_view name);

/// Text of a file of assets/plots: that in $CAREEN_DATA if it is set and has one, else the embedded one.
/// MachineError if there is neither.
std::string plotFile(const std::string& name);

}  // namespace careen
