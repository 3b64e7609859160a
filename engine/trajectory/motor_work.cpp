#include "trajectory/motor_work.h"

#include <algorithm>
#include <cmath>

#include "physics/world/joint.h"

namespace careen {

MotorWork::MotorWork(const Trajectory& run, std::span<const std::size_t> joints, Drives drives)
    : run_(run), drives_(drives) {
  for (const std::size_t index : joints) {
    const bool isDriven = std::any_of(
        run.jointEfforts.begin(), run.jointEfforts.end(),
        [&](const JointEffort& effort) { return static_cast<std::size_t>(effort.joint) == index; });
    const Joint& joint = run.world.joints[index];
    if (isDriven || ownEffort(joint) != 0) {
      motors_.push_back({.joint = &joint, .effort = ownEffort(joint), .coordinate = coordinateAt(joint, 0)});
    }
  }
}

double MotorWork::coordinateAt(const Joint& joint, double time) const {
  const auto poseOf = [&](const JointEnd& end) {
    return end.body ? run_.state(static_cast<std::size_t>(*end.body), time).pose : Pose{};
  };
  return jointCoordinate(joint, poseOf(joint.from), poseOf(joint.to));
}

double MotorWork::moveTo(Motor& motor, double time) const {
  const double coordinate = inNearestTurn(*motor.joint, coordinateAt(*motor.joint, time), motor.coordinate);
  const double way = coordinate - motor.coordinate;
  motor.coordinate = coordinate;
  motor.since = time;
  return motor.effort * way;
}

double MotorWork::move(Motor& motor, double time) const {
  // What lets go drives no more.
  const double until = std::min(time, std::max(motor.since, motor.joint->until));
  const Segments& segments = run_.tracks[static_cast<std::size_t>(*motor.joint->from.body)].segments;
  double work = 0;
  for (std::size_t k = segments.countUntil(motor.since); k < segments.countUntil(until); ++k) {
    work += moveTo(motor, segments[k].start);
  }
  return work + moveTo(motor, until);
}

double MotorWork::until(double time) {
  double work = 0;
  if (motors_.empty()) {
    return work;
  }
  for (; next_ < run_.jointEfforts.size() && run_.jointEfforts[next_].time <= time; ++next_) {
    const JointEffort& effort = run_.jointEfforts[next_];
    const Joint* const joint = &run_.world.joints[static_cast<std::size_t>(effort.joint)];
    for (Motor& motor : motors_) {
      if (motor.joint == joint) {
        work += move(motor, effort.time);
        motor.effort = effort.effort + ownEffort(*joint);
      }
    }
  }
  for (Motor& motor : motors_) {
    work += move(motor, time);
  }
  return work;
}

}  // namespace careen
