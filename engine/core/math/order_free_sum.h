#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace careen {

/// 2ᵏ with 2ᵏ ≤ |x| < 2ᵏ⁺¹, for a normal x: the same for x and −x.
inline double powerOfTwoBelow(double x) {
  constexpr std::uint64_t kExponent = 0x7ff0000000000000U;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & kExponent);
}

/// Nearest multiple of ulp(anchor). The anchor is 1.5 times a power of two, so that adding a term of either
/// sign stays in its binade, and an even multiple of its ulp, so that ties round alike for both signs.
inline double onGridOf(double anchor, double term) { return (anchor + term) - anchor; }

/// Sums of numbers with the same bits in any order, and exactly negated when all of them are negated. Several
/// sums in parallel, one per component, so that none waits for another.
///
/// A running sum has neither property: t₁ + t₂ − t₁ − t₂ need not vanish, and so a cube that lands flat would
/// leave with some spin. Here every term is first rounded to a common grid, coarse enough for sums of grid
/// points to be exact, and the remainders likewise to a finer one: two exact sums, then one rounded addition.
/// Error at most n 2⁻⁹⁰ of the largest term before that last rounding.
///
/// J. Demmel, H. D. Nguyen, "Fast reproducible floating-point summation", ARITH 21, 2013 (their K-fold sum, K
/// = 2). Terms must be finite and below 2⁹⁷⁰; at most 2⁸ of them for the error stated, never more than 2²⁰.
template <std::size_t kWidth>
std::array<double, kWidth> orderFreeSums(std::span<const std::array<double, kWidth>> terms) {
  std::array<double, kWidth> sums{};
  if (terms.size() <= 2) {  // one rounded addition has both properties already
    for (const std::array<double, kWidth>& term : terms) {
      for (std::size_t k = 0; k < kWidth; ++k) {
        sums[k] += term[k];
      }
    }
    return sums;
  }
  std::array<double, kWidth> largest{};
  for (const std::array<double, kWidth>& term : terms) {
    for (std::size_t k = 0; k < kWidth; ++k) {
      largest[k] = std::max(largest[k], std::fabs(term[k]));
    }
  }
  double room = 4;  // all sums of the grid points stay exact: below 2⁵² of the grid's steps
  for (std::size_t n = terms.size(); n > 1; n /= 2) {
    room *= 2;
  }
  constexpr double kUlp = 0x1p-52;
  std::array<double, kWidth> coarseAnchor;
  std::array<double, kWidth> fineAnchor;
  for (std::size_t k = 0; k < kWidth; ++k) {
    coarseAnchor[k] = 1.5 * room * powerOfTwoBelow(largest[k]);
    fineAnchor[k] = coarseAnchor[k] * (kUlp * room);
  }
  std::array<double, kWidth> fine{};
  for (const std::array<double, kWidth>& term : terms) {
    for (std::size_t k = 0; k < kWidth; ++k) {
      const double coarse = onGridOf(coarseAnchor[k], term[k]);
      sums[k] += coarse;
      fine[k] += onGridOf(fineAnchor[k], term[k] - coarse);
    }
  }
  for (std::size_t k = 0; k < kWidth; ++k) {
    sums[k] += fine[k];
  }
  return sums;
}

}  // namespace careen
