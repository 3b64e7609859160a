#pragma once

#include <string_view>
#include <vector>

namespace careen {

/// "0:2:0.1", from, to and step [s]: the moments 0, 0.1 … 2, each a rounding away from from + k·step, the
/// last one included if a step ends there. InputError otherwise, and beyond a thousand moments.
std::vector<double> parseStrobe(std::string_view text);

}  // namespace careen
