#pragma once

#include <cmath>
#include <utility>

#include "core/math/elementary.h"
#include "physics/attitude/free_step.h"

namespace careen {

/// A free body without the part of its motion that commutes with all the rest, for methods that step the
/// remainder.
///
/// With b the axis of the middle moment, the energy is
///
///     ½ Σ m²/I = |m|²/2Ib + ½ (1/Ia − 1/Ib) ma² + ½ (1/Ic − 1/Ib) mc².
///
/// The first term alone rotates the body steadily about L, by |L| t/Ib, and leaves m unchanged. It commutes
/// with every function of m, so that one such rotation at the end of a run covers all its steps (restored())
/// and adds no error. The remainder has no rate about b and smaller ones about a and c: none for a sphere,
/// one for a symmetric top. In the right-handed frame x, y, z with z = ±b,
///
///     m' = m × (αx mx, αy my, 0),   q' = ½ q (αx mx, αy my, 0).
///
/// Not used: the same with an axis other than b. Strang's errors are then 0.7 to 1.5 (largest moment) or 4 to
/// 30 times as large (smallest; measured at 1/60 s), and a symmetric top is exact only with the right one.
template <class Real>
struct MiddleAxisFrame {
  int x = 0;  // the body axes, x with the larger rate
  int y = 2;
  int z = 1;
  Real sign;            // of z
  Real alphaX, alphaY;  // [1/(kg m²)] 1/I − 1/Ib
  Real perMiddle;       // [1/(kg m²)] 1/Ib

  explicit MiddleAxisFrame(const Vector3<Real>& inertia) {
    using std::abs;
    const auto sort = [&](int& low, int& high) {
      if (inertia[high] < inertia[low]) {
        std::swap(low, high);
      }
    };
    sort(x, z);
    sort(z, y);
    sort(x, z);
    perMiddle = 1 / inertia[z];
    const auto rate = [&](int axis) {
      return Real((inertia[z] - inertia[axis]) / inertia[axis] * perMiddle);
    };
    if (abs(rate(x)) < abs(rate(y))) {
      std::swap(x, y);
    }
    alphaX = rate(x);
    alphaY = rate(y);
    sign = (y - x + 3) % 3 == 1 ? 1 : -1;
  }
};

/// q and m in that frame.
template <class Real>
struct MiddleAxisState {
  Real w, x, y, z;
  Real mx, my, mz;  // [kg m²/s]

  MiddleAxisState(const MiddleAxisFrame<Real>& frame, const FreeState<Real>& state)
      : w(state.worldFromBody.w()),
        x(state.worldFromBody.vec()[frame.x]),
        y(state.worldFromBody.vec()[frame.y]),
        z(state.worldFromBody.vec()[frame.z] * frame.sign),
        mx(state.bodyMomentum[frame.x]),
        my(state.bodyMomentum[frame.y]),
        mz(state.bodyMomentum[frame.z] * frame.sign) {}

  /// Back in the body's axes, rotated about L for `time` [s], q normalised.
  FreeState<Real> restored(const MiddleAxisFrame<Real>& frame, const Real& time) const {
    const auto alongBody = [&](const Real& alongX, const Real& alongY, const Real& alongZ) {
      Vector3<Real> v;
      v[frame.x] = alongX;
      v[frame.y] = alongY;
      v[frame.z] = alongZ * frame.sign;
      return v;
    };
    const Vector3<Real> m = alongBody(mx, my, mz);
    const Vector3<Real> axis = alongBody(x, y, z);
    Quaternion<Real> q(w, axis[0], axis[1], axis[2]);
    const Real length = m.norm();
    if (length > 0) {
      const elementary::SinCos<Real> half = elementary::sinCos(Real(length * frame.perMiddle * time / 2));
      const Vector3<Real> turn = m * Real(half.sin / length);
      q = q * Quaternion<Real>(half.cos, turn[0], turn[1], turn[2]);
    }
    return {unit(q), m};
  }
};

}  // namespace careen
