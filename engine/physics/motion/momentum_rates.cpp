#include "physics/motion/momentum_rates.h"

#include <cstddef>

namespace careen {
namespace {

// A polynomial and its derivatives with respect to time.
template <class Vector>
struct WithRates {
  Vector value = Vector::Zero();
  Vector rate = Vector::Zero();
  Vector bend = Vector::Zero();

  WithRates(const std::array<Vector, 6>& coefficients, double elapsed, double duration) {
    const double s = elapsed / duration;
    for (std::size_t k = coefficients.size(); k-- > 0;) {
      bend = bend * s + 2 * rate;
      rate = rate * s + value;
      value = value * s + coefficients[k];
    }
    rate /= duration;
    bend /= duration * duration;
  }
};

}  // namespace

MomentumRates momentumRatesAt(const ContactStep& step, const MassProperties& mass, double elapsed) {
  const WithRates<Vec3> place(step.position, elapsed, step.duration);
  const WithRates<Vec4> turn(step.worldFromBody, elapsed, step.duration);
  const Quat q(turn.value);
  const double perSize = 1 / turn.value.squaredNorm();
  // With q̇ q⁻¹ = (r, ½ω): ½ω̇ = vec(q̈ q⁻¹) − r ω, for a quaternion of any length.
  const Quat rate = Quat(turn.rate) * q.conjugate();
  const Quat bend = Quat(turn.bend) * q.conjugate();
  const Vec3 omega = 2 * perSize * rate.vec();
  const Vec3 omegaRate = 2 * perSize * (bend.vec() - rate.w() * omega);
  const Mat3 columns = q.normalized().toRotationMatrix();
  return {.linear = mass.mass * place.bend,
          .angular =
              angularMomentum(mass, columns, omegaRate) + omega.cross(angularMomentum(mass, columns, omega))};
}

}  // namespace careen
