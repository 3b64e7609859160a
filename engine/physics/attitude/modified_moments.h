#pragma once

#include "core/math/linear_algebra.h"

namespace careen {

/// 1/Ĩ [1/(kg m²)] of the moments Ĩ with which the discrete rigid body of moser_veselov.h steps like a body
/// of the given moments and momentum, up to terms of h¹⁰:
///
///     1/Ĩᵢ = (1 + s₁ + s₂ + s₃ + s₄)/Iᵢ + d₁ + d₂ + d₃ + d₄,
///
/// where sₖ and dₖ are polynomials of degree k in H = h² · energy = ½ h² Σ m²/I and C = ½ h² |m|², with
/// coefficients in terms of e₁ = Σ 1/Iᵢ, e₂ = Σ 1/(Iᵢ Iⱼ), e₃ = 1/(I₁ I₂ I₃). s₁ and d₁ alone give order 4.
///
/// The form is that of Hairer & Vilmart (J. Phys. A 39, 2006). The coefficients were derived here in rational
/// arithmetic: with g of the exact step as a Taylor series the equations of the method are linear in Ĩ, and
/// each sₖ, dₖ is the unique polynomial that fits the solutions for 60 bodies and momenta. Any wrong digit
/// shows as a lower order (moser_veselov_test.cpp).
template <class Real>
Vector3<Real> inverseModifiedMoments(const Vector3<Real>& inertia, const Vector3<Real>& momentumBody,
                                     const Real& h) {
  const Vector3<Real> inverse = inertia.cwiseInverse();
  const Real e1 = inverse.sum();
  const Real e2 = inverse[0] * inverse[1] + inverse[1] * inverse[2] + inverse[2] * inverse[0];
  const Real e3 = inverse.prod();
  const Real e11 = e1 * e1;
  const Real e22 = e2 * e2;
  const Real e33 = e3 * e3;
  const Real e13 = e1 * e3;
  // NOLINTBEGIN(readability-identifier-naming): notation of the papers
  const Real H = h * h / 2 * dot(momentumBody.cwiseProduct(inverse), momentumBody);
  const Real C = h * h / 2 * momentumBody.squaredNorm();
  const Real H2 = H * H;
  const Real C2 = C * C;
  // NOLINTEND(readability-identifier-naming)

  const Real s1 = (C * e2 - 2 * H * e1) / 6;
  const Real d1 = (H * e2 - 2 * C * e3) / 6;

  const Real s2 = (H2 * (2 * e11 - e2) + H * C * (8 * e3 - 2 * e1 * e2) + C2 * (2 * e22 - 6 * e13)) / 60;
  const Real d2 = (H * C * (8 * e13 - e22) - H2 * (e1 * e2 + 6 * e3) - C2 * e2 * e3) / 60;

  const Real s3 =
      (H2 * H * (4 * e1 * e2 - 4 * e11 * e1 + 72 * e3) + H2 * C * (6 * e11 * e2 + 41 * e22 - 212 * e13) +
       H * C2 * (132 * e11 * e3 - 36 * e1 * e22 - 30 * e2 * e3) +
       C2 * C * (17 * e22 * e2 - 66 * e13 * e2 + 100 * e33)) /
      2520;
  const Real d3 =
      (H2 * H * (2 * e11 * e2 - 26 * e22 + 60 * e13) +
       H2 * C * (13 * e1 * e22 - 64 * e11 * e3 + 110 * e2 * e3) +
       H * C2 * (2 * e22 * e2 - 2 * e13 * e2 - 176 * e33) + C2 * C * (72 * e13 * e3 - 19 * e22 * e3)) /
      2520;

  const Real s4 =
      (H2 * H2 * (2 * e11 * e11 - 3 * e11 * e2 + 153 * e22 - 486 * e13) +
       H2 * H * C * (1104 * e11 * e3 - 4 * e11 * e1 * e2 - 264 * e1 * e22 - 828 * e2 * e3) +
       H2 * C2 * (156 * e11 * e22 + 18 * e22 * e2 - 612 * e11 * e13 + 180 * e13 * e2 + 1908 * e33) +
       H * C2 * C * (612 * e11 * e2 * e3 - 154 * e1 * e22 * e2 + 282 * e22 * e3 - 2256 * e13 * e3) +
       C2 * C2 * (62 * e22 * e22 - 342 * e13 * e22 + 378 * e13 * e13 + 291 * e2 * e33)) /
      45360;
  const Real d4 =
      (H2 * H2 * (459 * e2 * e3 - e11 * e1 * e2 - 6 * e1 * e22 - 126 * e11 * e3) +
       H2 * H * C * (194 * e22 * e2 - 30 * e11 * e22 + 128 * e11 * e13 - 552 * e13 * e2 - 1296 * e33) +
       H2 * C2 * (114 * e11 * e2 * e3 - 30 * e1 * e22 * e2 - 798 * e22 * e3 + 2136 * e13 * e3) +
       H * C2 * C * (222 * e13 * e22 - e22 * e22 - 864 * e13 * e13 + 684 * e2 * e33) +
       C2 * C2 * (243 * e13 * e2 * e3 - 61 * e22 * e2 * e3 - 610 * e33 * e3)) /
      45360;

  const Real stretch = 1 + (s1 + (s2 + (s3 + s4)));
  const Real shift = d1 + (d2 + (d3 + d4));
  return (inverse * stretch).array() + shift;
}

}  // namespace careen
