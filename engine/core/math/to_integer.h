#pragma once

#include <concepts>
#include <limits>

namespace careen {

/// x without its fraction; `otherwise` where the type cannot hold that: for what is not a number, infinite or
/// too large the language leaves a conversion undefined.
template <std::signed_integral Integer, class Real>
constexpr Integer toInteger(const Real& x, Integer otherwise) {
  const Real end =
      static_cast<Real>(std::numeric_limits<Integer>::max() / 2 + 1) * 2;  // a power of two, exact
  return x < end && x >= -end ? static_cast<Integer>(x) : otherwise;
}

}  // namespace careen
