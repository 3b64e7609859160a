#pragma once

#include <string_view>
#include <vector>

namespace careen {

/// "0:2:0.1", i.e. FROM:TO:STEP [s]: the moments 0, 0.1 … 2, each FROM + k·STEP up to rounding, TO included
/// if a step ends there. InputError otherwise, and for more than a thousand moments.
std::vector<double> parseStrobe(std::string_view text);

}  // namespace careen
