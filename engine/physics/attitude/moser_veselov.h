#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/error.h"
#include "physics/attitude/free_step.h"
#include "physics/attitude/modified_moments.h"

namespace careen {

namespace detail {

inline constexpr const char* kTurnsTooFar = "Moser-Veselov: the body turns too far in one step";

template <class Real>
Vector3<Real> productsOfOthers(const Vector3<Real>& g) {
  return {g[1] * g[2], g[2] * g[0], g[0] * g[1]};
}

/// The small solution g of gᵢ + spreadᵢ gⱼ gₖ = startᵢ (1 + g²), by Newton's method from the given guess.
template <class Real>
Vector3<Real> halfTurn(const Vector3<Real>& start, const Vector3<Real>& spread, Vector3<Real> g) {
  constexpr int kMostIterations = 20;
  for (int i = 0; i < kMostIterations; ++i) {
    const Vector3<Real> twice = start + start;
    const Vector3<Real> residual =
        g + spread.cwiseProduct(productsOfOthers(g)) - start * (1 + g.squaredNorm());
    const Vector3<Real> row0(1 - twice[0] * g[0], spread[0] * g[2] - twice[0] * g[1],
                             spread[0] * g[1] - twice[0] * g[2]);
    const Vector3<Real> row1(spread[1] * g[2] - twice[1] * g[0], 1 - twice[1] * g[1],
                             spread[1] * g[0] - twice[1] * g[2]);
    const Vector3<Real> row2(spread[2] * g[1] - twice[2] * g[0], spread[2] * g[0] - twice[2] * g[1],
                             1 - twice[2] * g[2]);
    const Vector3<Real> cofactors = row1.cross(row2);
    const Real determinant = dot(row0, cofactors);
    if (!(determinant > 0)) {
      break;  // past the fold where the small solution ends
    }
    const Vector3<Real> correction =
        (residual[0] * cofactors + residual[1] * row2.cross(row0) + residual[2] * row0.cross(row1)) *
        Real(1 / determinant);
    g -= correction;
    // The equations are quadratic: the residual after this step is the square of the correction, times
    // |spread| ≤ 1.
    const Real left = correction.squaredNorm();
    const Real rounding = std::numeric_limits<Real>::epsilon() / 16;
    if (left * left <= rounding * rounding * g.squaredNorm()) {
      return g;
    }
  }
  throw NumericalError(kTurnsTooFar);
}

}  // namespace detail

/// The discrete rigid body of Moser and Veselov, with moments modified for order 10 in attitude.
///
/// **The step** is a rotation R from the body's axes at the start to those at the end, A ← A R, m ← Rᵀ m,
/// with R D − D Rᵀ = h m̃ and D = ½ tr(I) − I. For R as the quaternion (1, g)/√(1 + g²), g the axis times the
/// tangent of half the angle, these are three quadratic equations,
///
///     I₁ g₁ + (I₃ − I₂) g₂ g₃ = ½ h m₁ (1 + g²)       and cyclic, solved to rounding,
///     m₁ ← m₁ − 4 (I₃ − I₂) g₂ g₃ / (h (1 + g²))      and cyclic (Rᵀ m written out).
///
/// Half the sum of the old and the new m₁ is 2 I₁ g₁/(h (1 + g²)): its product with the change, over I₁ and
/// summed, is zero for any h, so energy and |m| are conserved.
///
/// **The moments** in the equations are not the body's. With the body's own, the step is that of another
/// body, whose moments differ by O(h²) and depend on energy and |m| only; modified_moments.h corrects this up
/// to h¹⁰. As both are constants it is done once per run, and a step costs the same at any order: the usual
/// order 4 has no advantage.
///
/// Order 10 in attitude. Conserved to rounding: energy, |m|, the momentum in the world. Symmetric. A quarter
/// turn in one step is too long (about a fixed axis sin hω = h m/Ĩ): NumericalError, `state` unchanged.
///
/// Sources: J. Moser & A. P. Veselov, Commun. Math. Phys. 139, 1991; R. I. McLachlan & A. Zanna, Found.
/// Comput. Math. 5, 2005 (order 4); E. Hairer & G. Vilmart, J. Phys. A 39, 2006 (attitude, quaternions, high
/// order).
template <class Real>
void moserVeselovSteps(const Vector3<Real>& inertia, FreeState<Real>& state, const Real& dt,
                       std::int64_t count) {
  using std::abs;
  if (!(abs(dt) * state.bodyMomentum.cwiseQuotient(inertia).norm() < 1.5)) {
    throw NumericalError(detail::kTurnsTooFar);
  }
  const Vector3<Real> inverse = inverseModifiedMoments(inertia, state.bodyMomentum, dt);
  const Vector3<Real> moments = inverse.cwiseInverse();
  const Vector3<Real> difference(moments[2] - moments[1], moments[0] - moments[2], moments[1] - moments[0]);
  const Vector3<Real> spread = difference.cwiseProduct(inverse);
  const Vector3<Real> halfStep = inverse * Real(dt / 2);
  const Vector3<Real> change = difference * Real(-4 / dt);
  FreeState<Real> s = state;
  for (std::int64_t i = 0; i < count; ++i) {
    const Vector3<Real> start = halfStep.cwiseProduct(s.bodyMomentum);
    // Initial guess: half the rotation at the mean momentum of the step, by the first terms of its series.
    const Vector3<Real> rate = spread.cwiseProduct(detail::productsOfOthers(start));
    const Vector3<Real> rateOfRate = spread.cwiseProduct(
        Vector3<Real>(start[1] * rate[2] + rate[1] * start[2], start[2] * rate[0] + rate[2] * start[0],
                      start[0] * rate[1] + rate[0] * start[1]));
    const Vector3<Real> g =
        detail::halfTurn<Real>(start, spread, (start - rate + rateOfRate) * Real(1 + start.squaredNorm()));
    s.bodyMomentum += change.cwiseProduct(detail::productsOfOthers(g)) * Real(1 / (1 + g.squaredNorm()));
    s.worldFromBody = unit<Real>(s.worldFromBody * Quaternion<Real>(Real(1), g[0], g[1], g[2]));
  }
  state = s;
}

}  // namespace careen
