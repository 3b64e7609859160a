#include "audit/flown.h"

#include <algorithm>
#include <cmath>

namespace careen {
namespace {

constexpr double kTurn = 0.03;  // [rad] in one step: its error is then below 1e-9
constexpr double kMostSteps = 4096;

Vec4 rateOf(const MassProperties& mass, const Vec4& attitude, const Vec3& angularMomentum) {
  const Quat q(Quat(attitude[3], attitude[0], attitude[1], attitude[2]).normalized());
  const Mat3 axes = q.toRotationMatrix();
  const Vec3 spin = axes * mass.inverseInertiaTimes(axes.transpose() * angularMomentum);
  return 0.5 * (Quat(0, spin.x(), spin.y(), spin.z()) * q).coeffs();
}

}  // namespace

BodyState flown(const MassProperties& mass, const BodyState& from, const Vec3& gravity, double seconds) {
  if (isImmovable(mass)) {
    return from;
  }
  BodyState state = from;
  state.pose.position += seconds * (from.velocity + 0.5 * seconds * gravity);
  state.velocity += seconds * gravity;
  const double turn = std::fabs(seconds) * mass.inverseInertiaBody.maxCoeff() * from.angularMomentum.norm();
  if (turn == 0) {
    return state;
  }
  const double steps = std::clamp(std::ceil(turn / kTurn), 1.0, kMostSteps);
  const double h = seconds / steps;
  Vec4 q = Quat(from.pose.worldFromBody).coeffs();
  for (int step = 0; step < static_cast<int>(steps); ++step) {
    const Vec4 k1 = rateOf(mass, q, from.angularMomentum);
    const Vec4 k2 = rateOf(mass, q + 0.5 * h * k1, from.angularMomentum);
    const Vec4 k3 = rateOf(mass, q + 0.5 * h * k2, from.angularMomentum);
    const Vec4 k4 = rateOf(mass, q + h * k3, from.angularMomentum);
    q = (q + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)).normalized();
  }
  state.pose.worldFromBody = Quat(q[3], q[0], q[1], q[2]).toRotationMatrix();
  return state;
}

Vec3 turnBetween(const Mat3& from, const Mat3& to) {
  const Quat turn(Mat3(to * from.transpose()));
  const double sine = turn.vec().norm();
  const double half = std::atan2(sine, std::fabs(turn.w()));
  return sine > 0 ? Vec3((turn.w() < 0 ? -2 : 2) * half / sine * turn.vec()) : Vec3(Vec3::Zero());
}

Vec3 velocityAt(const MassProperties& mass, const BodyState& state, const Vec3& place) {
  return isImmovable(mass)
             ? Vec3(Vec3::Zero())
             : Vec3(state.velocity + angularVelocity(mass, state).cross(place - state.pose.position));
}

}  // namespace careen
