#pragma once

#include <string_view>
#include <vector>

namespace careen {

/// The most numbers of a range.
inline constexpr int kMostInRange = 1000;

/// "0:2:0.1", FROM:TO:STEP: the numbers 0, 0.1 … 2, each FROM + k·STEP up to rounding, TO included if a step
/// ends there. Or one number. None is negative; InputError otherwise, and for more than kMostInRange.
std::vector<double> numbersOfRange(std::string_view text);

}  // namespace careen
