#pragma once

#include <cmath>
#include <cstdint>

#include "physics/attitude/free_step.h"

namespace careen {

namespace detail {

/// q and m, or their rates.
template <class Real>
struct AttitudeAndMomentum {
  Real w, x, y, z;
  Real m0, m1, m2;
};

template <class Real>
inline AttitudeAndMomentum<Real> rate(const AttitudeAndMomentum<Real>& s, const Vector3<Real>& inverse) {
  const Real a = s.m0 * inverse[0];
  const Real b = s.m1 * inverse[1];
  const Real c = s.m2 * inverse[2];
  const Real half(0.5);
  return {-half * (s.x * a + s.y * b + s.z * c),
          half * (s.w * a + s.y * c - s.z * b),
          half * (s.w * b + s.z * a - s.x * c),
          half * (s.w * c + s.x * b - s.y * a),
          s.m1 * c - s.m2 * b,
          s.m2 * a - s.m0 * c,
          s.m0 * b - s.m1 * a};
}

template <class Real>
inline AttitudeAndMomentum<Real> moved(const AttitudeAndMomentum<Real>& s, const AttitudeAndMomentum<Real>& d,
                                       const Real& h) {
  return {s.w + h * d.w,   s.x + h * d.x,   s.y + h * d.y,  s.z + h * d.z,
          s.m0 + h * d.m0, s.m1 + h * d.m1, s.m2 + h * d.m2};
}

/// One step, without normalising the quaternion.
template <class Real>
inline AttitudeAndMomentum<Real> rungeKutta4Step(const AttitudeAndMomentum<Real>& s,
                                                 const Vector3<Real>& inverse, const Real& dt) {
  const auto k1 = rate(s, inverse);
  const auto k2 = rate(moved(s, k1, Real(dt / 2)), inverse);
  const auto k3 = rate(moved(s, k2, Real(dt / 2)), inverse);
  const auto k4 = rate(moved(s, k3, dt), inverse);
  return moved(moved(moved(moved(s, k1, Real(dt / 6)), k2, Real(dt / 3)), k3, Real(dt / 3)), k4,
               Real(dt / 6));
}

}  // namespace detail

/// The classical Runge–Kutta method on (q, m), with the quaternion normalised after each step.
///
/// Order 4 in attitude, energy and momentum. Conserves none of energy, |m| and the momentum in the world:
/// within a period of the polhode their errors are of order 4 and periodic (the leading term is odd in time),
/// the remaining drift is of order 5 and grows with time. Not symmetric.
///
/// Source: W. Kutta, Z. Math. Phys. 46, 1901.
template <class Real>
void rungeKutta4Steps(const Vector3<Real>& inertia, FreeState<Real>& state, const Real& dt,
                      std::int64_t count) {
  using std::sqrt;
  const Vector3<Real> inverse = inertia.cwiseInverse();
  const Quaternion<Real>& q = state.worldFromBody;
  const Vector3<Real>& m = state.bodyMomentum;
  detail::AttitudeAndMomentum<Real> s{q.w(), q.x(), q.y(), q.z(), m[0], m[1], m[2]};
  for (std::int64_t i = 0; i < count; ++i) {
    s = detail::rungeKutta4Step(s, inverse, dt);
    const Real inverseLength = 1 / sqrt(s.w * s.w + s.x * s.x + s.y * s.y + s.z * s.z);
    s.w *= inverseLength;
    s.x *= inverseLength;
    s.y *= inverseLength;
    s.z *= inverseLength;
  }
  state = {Quaternion<Real>(s.w, s.x, s.y, s.z), Vector3<Real>(s.m0, s.m1, s.m2)};
}

}  // namespace careen
