#pragma once

#include <bit>
#include <cstdint>
#include <span>

namespace careen {

/// Sum of numbers, the same bits in whatever order they stand, and exactly negated when all of them are
/// negated.
///
/// A running sum has neither property: t₁ + t₂ − t₁ − t₂ need not vanish, and so a cube that lands flat would
/// leave with a trace of spin. Here every term is first rounded to a grid common to all, coarse enough for
/// the grid points to add without rounding, and so is what was rounded off: two exact sums, then one rounded
/// addition. Error at most n 2⁻⁹⁰ of the largest term before that last rounding.
///
/// J. Demmel, H. D. Nguyen, "Fast reproducible floating-point summation", ARITH 21, 2013 (their K-fold sum, K
/// = 2). Terms must be finite and below 2⁹⁷⁰; at most 2⁸ of them for the error stated, never more than 2²⁰.
double orderFreeSum(std::span<const double> terms);

/// 2ᵏ ≤ |x| < 2ᵏ⁺¹ as a double, for a normal x: the same for x and −x.
inline double powerOfTwoBelow(double x) {
  constexpr std::uint64_t kExponent = 0x7ff0000000000000U;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & kExponent);
}

}  // namespace careen
