#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/math/linear_algebra.h"
#include "core/math/wide.h"

namespace careen {

/// The part of a body's free rotation that is the same for all its flights. Computed once per body, because
/// it takes as long as a flight's own set-up.
///
/// Denominators are cleared: with V = I₁ I₂ I₃, n₁₂ = (I₂ − I₁) I₃ stands for V (1/I₁ − 1/I₂), and so on.
/// Differences are thus taken of the moments themselves, where they are exact when it matters.
template <class Real>
struct PrincipalMoments {
  using Extended = Wide<Real>;

  std::array<Real, 3> alongBody;         // [kg m²]
  std::array<Real, 3> inverseAlongBody;  // [1/(kg m²)]
  std::array<std::size_t, 3> order;      // the body axes of I₁ ≤ I₂ ≤ I₃
  std::array<Extended, 3> inverse;       // [1/(kg m²)] 1/I₁, 1/I₂, 1/I₃
  std::array<Extended, 2> n;             // [kg² m⁴] n₁₂, n₂₃
  Extended n13;                          // [kg² m⁴] their sum
  std::array<Real, 2> perN;              // [1/(kg² m⁴)] 1/n₁₂, 1/n₂₃, or 0 where n is 0
  Real perN13;                           // [1/(kg² m⁴)] likewise
  Extended perVolume;                    // [1/(kg³ m⁶)] 1/V
  // For momentum circling axis 1, and axis 3: √(n₁₃/nAB) if nAB, n₁₂ or n₂₃, is the larger of these two, else
  // √(n₁₃ nAB). Times a₀, or times G, this is a₀√p of the precession's integral.
  std::array<Extended, 2> precessionRoot;

  /// Positive and finite [kg m²].
  explicit PrincipalMoments(const Vector3<Real>& moments)
      : alongBody{moments[0], moments[1], moments[2]},
        inverseAlongBody{1 / moments[0], 1 / moments[1], 1 / moments[2]} {
    using std::sqrt;
    const auto before = [&](int i, int j) {
      return moments[j] < moments[i] ? std::size_t{1} : std::size_t{0};
    };
    order[before(0, 1) + before(0, 2)] = 0;
    order[1 - before(0, 1) + before(1, 2)] = 1;
    order[2 - before(0, 2) - before(1, 2)] = 2;
    const Real i1 = alongBody[order[0]];
    const Real i2 = alongBody[order[1]];
    const Real i3 = alongBody[order[2]];
    n = {wideDifference<Extended>(i2, i1) * i3, wideDifference<Extended>(i3, i2) * i1};
    n13 = wideDifference<Extended>(i3, i1) * i2;
    const auto inverseOf = [](const Extended& x) {
      const Real value = static_cast<Real>(x);
      return value > 0 ? Real(1 / value) : Real(0);
    };
    perN = {inverseOf(n[0]), inverseOf(n[1])};
    perN13 = inverseOf(n13);
    inverse = {Extended(1) / Extended(i1), Extended(1) / Extended(i2), Extended(1) / Extended(i3)};
    perVolume = Extended(1) / Extended(wideProduct<Extended>(i1, i2) * i3);
    for (std::size_t circled = 0; circled < 2; ++circled) {
      precessionRoot[circled] =
          isLarger(circled) ? sqrt(Extended(n13 / n[circled])) : sqrt(Extended(n13 * n[circled]));
    }
  }

  /// Whether n₁₂ (0) or n₂₃ (1) is positive and not less than the other.
  bool isLarger(std::size_t which) const {
    const Real mine = static_cast<Real>(n[which]);
    return mine > 0 && mine >= static_cast<Real>(n[1 - which]);
  }
};

}  // namespace careen
