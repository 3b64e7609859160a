#include "trajectory/joint_samples.h"

#include "physics/world/forces.h"

namespace careen {

JointSamples::JointSamples(const Trajectory& run)
    : run_(run), coordinates_(run.world.joints.size(), 0), efforts_(run.world.joints.size(), 0) {
  for (std::size_t j = 0; j < run.world.joints.size(); ++j) {
    if (run.world.joints[j].hasCoordinate()) {
      joints_.push_back(j);
    }
  }
  for (const Body& body : run.world.bodies) {
    states_.push_back(body.initial);
  }
}

std::vector<JointSamples::Row> JointSamples::at(double time) {
  for (; next_ < run_.jointEfforts.size() && run_.jointEfforts[next_].time <= time; ++next_) {
    efforts_[static_cast<std::size_t>(run_.jointEfforts[next_].joint)] = run_.jointEfforts[next_].effort;
  }
  std::vector<Row> rows;
  for (const std::size_t j : joints_) {
    const Joint& joint = run_.world.joints[j];
    for (const JointEnd* end : {&joint.from, &joint.to}) {
      if (end->body) {
        const auto body = static_cast<std::size_t>(*end->body);
        states_[body] = run_.state(body, time);
      }
    }
    const JointMotion motion = jointMotionOf(joint, run_.world, states_);
    coordinates_[j] = inNearestTurn(joint, motion.coordinate, coordinates_[j]);
    rows.push_back({coordinates_[j], motion.rate, efforts_[j]});
  }
  return rows;
}

}  // namespace careen
