#pragma once

#include <array>
#include <cmath>

#include "core/math/linear_algebra.h"

namespace careen {

/// Oracle of torque-free rotation: classical Runge–Kutta on the quaternion in extended precision. L is
/// constant in the world, so only q̇ = ½ q ω is integrated. Shares nothing with the engine but the vector
/// type.
class FreeTop {
 public:
  using Real = long double;
  using Vec = Vector3<Real>;
  using Q = std::array<Real, 4>;  // w x y z

  FreeTop(const Vec3& inertiaBody, const Vec3& angularMomentumWorld)
      : inertia_(inertiaBody.cast<Real>()), momentum_(angularMomentumWorld.cast<Real>()) {}

  void advance(double duration, int steps) {
    const Real h = static_cast<Real>(duration) / steps;
    for (int i = 0; i < steps; ++i) {
      const Q k1 = rate(q_);
      const Q k2 = rate(sum(q_, h / 2, k1));
      const Q k3 = rate(sum(q_, h / 2, k2));
      const Q k4 = rate(sum(q_, h, k3));
      q_ = sum(sum(sum(sum(q_, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
    }
  }

  Matrix3<Real> worldFromBody() const {
    const auto [w, x, y, z] = q_;
    const Real s = 2 / (w * w + x * x + y * y + z * z);
    Matrix3<Real> m;
    m << 1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),  //
        s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x),   //
        s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y);
    return m;
  }
  Vec momentumBody() const { return worldFromBody().transpose() * momentum_; }
  Real energy() const { return momentumBody().cwiseQuotient(inertia_).dot(momentumBody()) / 2; }

 private:
  static Q sum(const Q& a, Real h, const Q& b) {
    return {a[0] + h * b[0], a[1] + h * b[1], a[2] + h * b[2], a[3] + h * b[3]};
  }
  // ½ q ω with ω in the body frame.
  Q rate(const Q& q) const {
    FreeTop here(*this);
    here.q_ = q;
    const Vec omega = here.momentumBody().cwiseQuotient(inertia_) / 2;
    return {-q[1] * omega.x() - q[2] * omega.y() - q[3] * omega.z(),
            q[0] * omega.x() + q[2] * omega.z() - q[3] * omega.y(),
            q[0] * omega.y() + q[3] * omega.x() - q[1] * omega.z(),
            q[0] * omega.z() + q[1] * omega.y() - q[2] * omega.x()};
  }

  Vec inertia_;
  Vec momentum_;
  Q q_{1, 0, 0, 0};
};

/// Angle between two orientations [rad].
inline double angleBetween(const Matrix3<long double>& a, const Mat3& b) {
  const Matrix3<long double> turn = a.transpose() * b.cast<long double>();
  // From the skew part and the trace: accurate for small angles and near a half turn.
  const Vector3<long double> skew(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
  return static_cast<double>(std::atan2(skew.norm(), turn.trace() - 1));
}

}  // namespace careen
