#include "physics/exact/changing_world.h"

#include <algorithm>
#include <cmath>

#include "physics/world/forces.h"

namespace careen {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

ChangingWorld::ChangingWorld(const World& world)
    : world_(world), samples_(world.joints.size()), isDriven_(world.joints.size(), 0) {
  if (world_.control) {
    for (const Motor& motor : world_.control->motors) {
      isDriven_[static_cast<std::size_t>(motor.joint)] = 1;
    }
    for (std::size_t j = 0; j < isDriven_.size(); ++j) {
      isDriven_[j] =
          isDriven_[j] != 0 || (world_.control->callback && world_.joints[j].hasCoordinate()) ? 1 : 0;
    }
  }
  release(-kNever);
  findNextPart(0);
}

double ChangingWorld::nextGravity() const {
  return world_.gravityChanges.empty() ? kNever : world_.gravityChanges.front().time;
}

void ChangingWorld::findNextPart(double after) {
  nextPart_ = kNever;
  for (const Body& body : world_.bodies) {
    nextPart_ = std::min(nextPart_, nextPart(body.course, after));
  }
  for (const Wall& wall : world_.walls) {
    nextPart_ = std::min(nextPart_, nextPart(wall.course, after));
  }
}

void ChangingWorld::jump() {
  const double time = nextJump();
  if (nextGravity() <= time) {
    world_.gravity = world_.gravityChanges.front().gravity;
    world_.gravitySince = world_.gravityChanges.front().time;
    world_.gravityChanges.erase(world_.gravityChanges.begin());
  }
  findNextPart(time);
}

// By multiplication: no sum of periods.
double ChangingWorld::nextSample() const {
  return world_.control ? static_cast<double>(sampled_) * world_.control->period : kNever;
}

double ChangingWorld::nextOf(int joint) const {
  const auto j = static_cast<std::size_t>(joint);
  const double until = world_.joints[j].until;
  if (until <= changed_) {
    return kNever;
  }
  return isDriven_[j] != 0 ? std::min(until, nextSample()) : until;
}

void ChangingWorld::change(std::span<const BodyState> states, Recorder& recorder) {
  const double time = next();
  changed_ = time;
  if (nextRelease_ <= time) {
    for (const JointEffort& effort : release(time)) {
      recorder.drives(effort);
    }
  }
  if (nextSample() <= time) {
    sample(time, states, recorder);
    ++sampled_;
  }
}

// What has let go has no load; the next one that will.
std::vector<JointEffort> ChangingWorld::release(double time) {
  std::vector<JointEffort> ended;
  nextRelease_ = kNever;
  for (Joint& joint : world_.joints) {
    if (joint.until <= time) {
      if (joint.effort != 0) {
        ended.push_back({.time = time, .joint = static_cast<int>(&joint - world_.joints.data())});
      }
      joint.stiffness = joint.damping = joint.effort = joint.grip = 0;
    } else {
      nextRelease_ = std::min(nextRelease_, joint.until);
    }
  }
  return ended;
}

void ChangingWorld::sample(double time, std::span<const BodyState> states, Recorder& recorder) {
  for (std::size_t j = 0; j < samples_.size(); ++j) {
    const Joint& joint = world_.joints[j];
    if (!joint.hasCoordinate()) {
      continue;
    }
    const JointMotion motion = jointMotionOf(joint, world_, states);
    samples_[j] = {.coordinate = inNearestTurn(joint, motion.coordinate, samples_[j].coordinate),
                   .rate = motion.rate};
  }
  std::vector<double> efforts = motorEfforts(*world_.control, time, samples_);
  if (world_.control->callback) {
    world_.control->callback(time, states, samples_, efforts);
  }
  for (std::size_t j = 0; j < efforts.size(); ++j) {
    Joint& joint = world_.joints[j];
    const double effort = isDriven_[j] != 0 && time < joint.until ? efforts[j] : 0;
    if (effort != joint.effort) {
      joint.effort = effort;
      recorder.drives({.time = time, .joint = static_cast<int>(j), .effort = effort});
    }
  }
}

}  // namespace careen
