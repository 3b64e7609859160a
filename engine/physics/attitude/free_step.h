#pragma once

#include "core/math/linear_algebra.h"

namespace careen {

/// State of a torque-free rigid body for stepping methods:
///
///     q' = ½ q ω,   m' = m × ω,   ωᵢ = mᵢ/Iᵢ.
///
/// A method is a function of this state that takes `count` steps of dt [s] (either sign) for principal
/// moments `inertia` [kg m²] along the body's axes. It takes them in one call so that what all steps share is
/// computed once, as is what only the end of a run needs. The quaternion has unit length at the start, and to
/// rounding at the end.
template <class Real>
struct FreeState {
  Quaternion<Real> worldFromBody;
  Vector3<Real> bodyMomentum;  // [kg m²/s] m = Aᵀ L

  Vector3<Real> angularMomentumWorld() const { return worldFromBody * bodyMomentum; }
};

/// q normalised.
template <class Real>
Quaternion<Real> unit(Quaternion<Real> q) {
  using std::sqrt;
  const Real inverseLength = 1 / sqrt(q.squaredNorm());
  q.coeffs() *= inverseLength;
  return q;
}

}  // namespace careen
