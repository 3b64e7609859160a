#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/exact/exact_world.h"
#include "support/exact_runs.h"

namespace careen::test {

/// [1] A frame with that z axis.
inline Mat3 frameAlong(const Vec3& axis) {
  const Vec3 z = axis.normalized();
  const Vec3 x = z.unitOrthogonal();
  Mat3 frame;
  frame << x, z.cross(x), z;
  return frame;
}

/// An end at that place [m] and with those axes, both of the world at the start.
inline JointEnd endAt(const World& world, std::optional<int> body, const Vec3& place, const Mat3& axes) {
  if (!body) {
    return {.body = {}, .point = place, .axes = axes};
  }
  const Pose& pose = world.bodies[static_cast<std::size_t>(*body)].initial.pose;
  return {.body = body,
          .point = pose.worldFromBody.transpose() * (place - pose.position),
          .axes = pose.worldFromBody.transpose() * axes};
}

/// Adds a joint at that place [m]; its bodies pass through each other.
inline Joint& join(World& world, Joint::Kind kind, int from, std::optional<int> to, const Vec3& at,
                   const Vec3& axis = Vec3::UnitZ()) {
  const Mat3 frame = frameAlong(axis);
  Joint joint;
  joint.kind = kind;
  joint.from = endAt(world, from, at, frame);
  joint.to = endAt(world, to, at, frame);
  if (to) {
    world.apart.emplace_back(std::min(from, *to), std::max(from, *to));
    std::sort(world.apart.begin(), world.apart.end());
  }
  world.joints.push_back(joint);
  return world.joints.back();
}

/// A rope or rod from a place on the body [m, body frame] to one of the world [m].
inline Joint& tie(World& world, Joint::Kind kind, int from, const Vec3& point, const Vec3& place,
                  double length) {
  Joint joint;
  joint.kind = kind;
  joint.from = {.body = from, .point = point};
  joint.to = {.body = {}, .point = place};
  joint.length = length;
  world.joints.push_back(joint);
  return world.joints.back();
}

/// [m] How far a joint's points are from where they may be, at that moment of a run.
inline double gapIn(const World& world, const Recorded& run, const Joint& joint, double time) {
  const Pose from = run.at(world, static_cast<std::size_t>(*joint.from.body), time).pose;
  const Pose to = joint.to.body ? run.at(world, static_cast<std::size_t>(*joint.to.body), time).pose : Pose{};
  const Vec3 apart = joint.from.pointAt(from) - joint.to.pointAt(to);
  switch (joint.kind) {
    case Joint::Kind::kRope:
      return std::max(0.0, apart.norm() - joint.length);
    case Joint::Kind::kRod:
      return std::fabs(apart.norm() - joint.length);
    case Joint::Kind::kSlider:
      return apart.cross(joint.to.axesAt(to).col(2)).norm();
    case Joint::Kind::kBall:
    case Joint::Kind::kHinge:
    case Joint::Kind::kFixed:
      break;
  }
  return apart.norm();
}

/// [m] The largest of all joints at 998 moments, which the method does not choose.
inline double largestGapIn(const World& world, const Recorded& run, double duration) {
  double largest = 0;
  for (int k = 0; k <= 997; ++k) {
    for (const Joint& joint : world.joints) {
      largest = std::max(largest, gapIn(world, run, joint, duration * k / 997));
    }
  }
  return largest;
}

/// [J] Kinetic and potential, of all that moves.
inline double energyIn(const World& world, const Recorded& run, double time) {
  double energy = 0;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    if (!isImmovable(world.bodies[i].mass)) {
      energy += energyOf(world, i, run.at(world, i, time));
    }
  }
  return energy;
}

/// Angle [rad] and rate [rad/s] of θ'' = −k² sin θ after a time [s], by Runge's method of order 4 in extended
/// precision: to 15 digits.
inline std::array<double, 2> pendulumAfter(double time, long double angle, long double rate,
                                           long double squaredFrequency) {
  constexpr int kSteps = 200000;
  const long double h = static_cast<long double>(time) / kSteps;
  const auto pull = [&](long double at) { return -squaredFrequency * std::sin(at); };
  for (int k = 0; k < kSteps; ++k) {
    const long double rate1 = rate;
    const long double pull1 = pull(angle);
    const long double rate2 = rate + h / 2 * pull1;
    const long double pull2 = pull(angle + h / 2 * rate1);
    const long double rate3 = rate + h / 2 * pull2;
    const long double pull3 = pull(angle + h / 2 * rate2);
    const long double rate4 = rate + h * pull3;
    const long double pull4 = pull(angle + h * rate3);
    angle += h / 6 * (rate1 + 2 * rate2 + 2 * rate3 + rate4);
    rate += h / 6 * (pull1 + 2 * pull2 + 2 * pull3 + pull4);
  }
  return {static_cast<double>(angle), static_cast<double>(rate)};
}

/// A bar of 1 m and 1 kg that hangs from the origin, turned by that angle [rad] about y, and k² of it.
inline Body bar(const std::string& name, double angle, const Vec3& from = Vec3::Zero()) {
  Body body = box(name, Vec3(0.05, 0.05, 0.5), 1, Vec3::Zero());
  body.initial.pose.worldFromBody = Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix();
  body.initial.pose.position = from + body.initial.pose.worldFromBody * Vec3(0, 0, -0.5);
  return body;
}
/// Two such bars, turned by that angle [rad], on hinges at (±0.3, 0, 0), and a bridge of 2 kg on hinges at
/// their ends: three of its 20 rows are redundant.
inline World parallelogram(double angle, const Vec3& gravity) {
  World world;
  world.gravity = gravity;
  world.bodies = {bar("left", angle, Vec3(-0.3, 0, 0)), bar("right", angle, Vec3(0.3, 0, 0))};
  const Vec3 tip = world.bodies[0].initial.pose.worldFromBody * Vec3(0, 0, -1);
  world.bodies.push_back(box("bridge", Vec3(0.3, 0.05, 0.05), 2, tip));
  for (const double x : {-0.3, 0.3}) {
    const int side = x < 0 ? 0 : 1;
    join(world, Joint::Kind::kHinge, side, {}, Vec3(x, 0, 0), Vec3::UnitY());
    join(world, Joint::Kind::kHinge, side, 2, Vec3(x, 0, 0) + tip, Vec3::UnitY());
  }
  return world;
}
inline long double squaredFrequencyOf(const Body& bar, double gravity) {
  return gravity * 0.5L / (bar.mass.inertiaBody[1] + 0.25L);
}

}  // namespace careen::test
