#include "physics/world/control.h"

#include <algorithm>

#include "core/math/elementary.h"

namespace careen {
namespace {

constexpr double kTurn = 2 * 3.141592653589793;

MotorTarget::Aim onPath(const std::vector<std::pair<double, double>>& path, double time) {
  const auto next = std::find_if(path.begin(), path.end(),
                                 [&](const std::pair<double, double>& point) { return point.first > time; });
  if (next == path.begin() || next == path.end()) {
    return {.coordinate = next == path.begin() ? path.front().second : path.back().second};
  }
  const auto& [from, low] = *(next - 1);
  const double rate = (next->second - low) / (next->first - from);
  return {.coordinate = low + rate * (time - from), .rate = rate};
}

double effortOf(const Motor& motor, double time, std::span<const JointSample> joints) {
  const JointSample& own = joints[static_cast<std::size_t>(motor.joint)];
  const MotorTarget::Aim aim = motor.target.at(time);
  double effort = motor.stiffness * (aim.coordinate - own.coordinate) + motor.damping * (aim.rate - own.rate);
  for (const Motor::Gain& gain : motor.gains) {
    const JointSample& joint = joints[static_cast<std::size_t>(gain.joint)];
    effort -= gain.k * joint.coordinate + gain.d * joint.rate;
  }
  return std::clamp(effort, -motor.largest, motor.largest);
}

}  // namespace

MotorTarget::Aim MotorTarget::at(double time) const {
  if (!path.empty()) {
    return onPath(path, time);
  }
  const double frequencyOfTurn = kTurn * frequency;
  const elementary::SinCos<double> angle = elementary::sinCos(frequencyOfTurn * time + phase);
  const bool grows = time < ramp;
  const double grown = grows ? time / ramp : 1;
  return {.coordinate = offset + amplitude * grown * angle.sin,
          .rate = amplitude * (grown * frequencyOfTurn * angle.cos + (grows ? angle.sin / ramp : 0))};
}

std::vector<double> motorEfforts(const Control& control, double time, std::span<const JointSample> joints) {
  std::vector<double> efforts(joints.size(), 0.0);
  for (const Motor& motor : control.motors) {
    efforts[static_cast<std::size_t>(motor.joint)] += effortOf(motor, time, joints);
  }
  return efforts;
}

}  // namespace careen
