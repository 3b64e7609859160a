#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "core/math/linear_algebra.h"
#include "physics/search/time_of_impact.h"

namespace careen::test {

// Rotation about a unit axis, by the half angle; for any scalar and independent of the engine's rotations.
template <class Real>
Matrix3<Real> turned(const Vector3<Real>& axis, const Real& angle) {
  using std::cos;
  using std::sin;
  const Real s = sin(angle / 2);
  const Real c = cos(angle / 2);
  const Real x = s * axis.x();
  const Real y = s * axis.y();
  const Real z = s * axis.z();
  Matrix3<Real> m;
  m << 1 - 2 * (y * y + z * z), 2 * (x * y - c * z), 2 * (x * z + c * y),  //
      2 * (x * y + c * z), 1 - 2 * (x * x + z * z), 2 * (y * z - c * x),   //
      2 * (x * z - c * y), 2 * (y * z + c * x), 1 - 2 * (x * x + y * y);
  return m;
}

/// Free flight of a symmetric top in closed form: A(t) = turn(L̂, Ωp t) · A₀ · turn(ê, Ωs t). Precession
/// about L and spin about the body's axis are both steady, so |ω| and |ω̇| are constant: the bounds are
/// exact.
struct TumblingBox {
  Vec3 halfExtents = Vec3::Ones();
  Vec3 position = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  Vec3 gravity = Vec3::Zero();
  Vec3 jerk = Vec3::Zero();
  Mat3 start = Mat3::Identity();
  Vec3 momentumAxis = Vec3::UnitZ();
  Vec3 spinAxis = Vec3::UnitX();  // body frame
  double precession = 0;
  double spin = 0;

  template <class Real>
  Matrix3<Real> orientation(const Real& t) const {
    return turned<Real>(momentumAxis.cast<Real>(), Real(precession) * t) * start.cast<Real>() *
           turned<Real>(spinAxis.cast<Real>(), Real(spin) * t);
  }
  template <class Real>
  Vector3<Real> centre(const Real& t) const {
    return position.cast<Real>() + velocity.cast<Real>() * t + gravity.cast<Real>() * (t * t / 2) +
           jerk.cast<Real>() * (t * t * t / 6);
  }
  template <class Real>
  std::array<Vector3<Real>, 8> corners(const Real& t) const {
    const Matrix3<Real> turn = orientation<Real>(t);
    const Vector3<Real> middle = centre<Real>(t);
    std::array<Vector3<Real>, 8> result;
    for (unsigned k = 0; k < 8; ++k) {
      const Vec3 signs((k & 4U) != 0 ? -1 : 1, (k & 2U) != 0 ? -1 : 1, (k & 1U) != 0 ? -1 : 1);
      const Vec3 local = halfExtents.cwiseProduct(signs);
      result.at(k) = middle + turn * local.cast<Real>();
    }
    return result;
  }

  Attitude operator()(double t) const {
    const Mat3 turn = turned<double>(momentumAxis, precession * t) * start;
    const Vec3 omega = precession * momentumAxis + spin * (turn * spinAxis);
    return {.worldFromBody = turn * turned<double>(spinAxis, spin * t), .angularVelocity = omega};
  }
  MovingBox moving() const {
    const Vec3 spinning = spin * (start * spinAxis);
    const Vec3 precessing = precession * momentumAxis;
    return {.halfExtents = halfExtents,
            .position = position,
            .velocity = velocity,
            .acceleration = gravity,
            .angularSpeedBound = (spinning + precessing).norm() * (1 + 1e-14),
            .angularAccelerationBound = precessing.cross(spinning).norm() * (1 + 1e-14),
            .attitude = AttitudeView(*this),
            .jerk = jerk,
            .lasts = 2};
  }
};

/// Random numbers that are the same with every standard library.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
  }
  Vec3 vector(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
  Vec3 direction() {
    Vec3 v = vector(1);
    while (v.squaredNorm() > 1 || v.squaredNorm() < 0.01) {
      v = vector(1);
    }
    return v.normalized();
  }
  // One draw per statement: compilers evaluate arguments in either order.
  Mat3 orientation() {
    const Vec3 axis = direction();
    return turned<double>(axis, between(-3.1, 3.1));
  }

 private:
  std::mt19937_64 engine_;
};

/// The same box mirrored across x = 0, or running backwards from `end`, by sign changes alone.
struct MirroredBox {
  const TumblingBox& box;
  Attitude operator()(double t) const {
    const Attitude seen = box(t);
    const Vec3 mirror(-1, 1, 1);
    return {.worldFromBody = mirror.asDiagonal() * seen.worldFromBody * mirror.asDiagonal(),
            .angularVelocity = -mirror.cwiseProduct(seen.angularVelocity)};
  }
  MovingBox moving() const {
    const Vec3 mirror(-1, 1, 1);
    MovingBox result = box.moving();
    result.position = mirror.cwiseProduct(result.position);
    result.velocity = mirror.cwiseProduct(result.velocity);
    result.acceleration = mirror.cwiseProduct(result.acceleration);
    result.attitude = AttitudeView(*this);
    return result;
  }
};
struct ReversedBox {
  const TumblingBox& box;
  double end = 0;
  Attitude operator()(double t) const {
    const Attitude seen = box(end - t);
    return {.worldFromBody = seen.worldFromBody, .angularVelocity = -seen.angularVelocity};
  }
  MovingBox moving() const {
    MovingBox result = box.moving();
    result.position = box.centre(end);
    result.velocity = -(box.velocity + end * box.gravity);
    result.attitude = AttitudeView(*this);
    return result;
  }
};

inline TumblingBox tumblingBox(Dice& dice, const Vec3& halfExtents, double speed, double turning) {
  return {.halfExtents = halfExtents,
          .position = Vec3::Zero(),
          .velocity = dice.vector(speed),
          .gravity = Vec3::Zero(),
          .jerk = Vec3::Zero(),
          .start = dice.orientation(),
          .momentumAxis = dice.direction(),
          .spinAxis = dice.direction(),
          .precession = dice.between(-turning, turning),
          .spin = dice.between(-turning, turning)};
}

}  // namespace careen::test
