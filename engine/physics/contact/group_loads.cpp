#include "physics/contact/group_loads.h"

#include <algorithm>

namespace careen {

GroupLoads::GroupLoads(const TouchingGroup& group) : group_(group), loads_(group.size()) {
  if (hasVaryingLoads(group.world())) {
    for (const Body& body : group.world().bodies) {
      worldStates_.push_back(body.initial);
    }
  }
}

void GroupLoads::find(const GroupState& at) {
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    loads_[i] = {};
    if (!group_.isHeld(i)) {
      loads_[i].force = group_.body(i).mass.mass * gravityNow(group_.world(), at[i].time);
    }
  }
  if (worldStates_.empty()) {
    return;
  }
  Vec3 gravity = group_.world().gravity;
  const auto inWorld = [&](std::size_t i) { return static_cast<std::size_t>(group_.bodies()[i].index); };
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    if (!group_.isHeld(i)) {
      worldStates_[inWorld(i)] = at[i].state();
      gravity = gravityNow(group_.world(), at[i].time);  // all are there at one time
    }
  }
  computeLoads(group_.world(), gravity, worldStates_, worldLoads_);
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    if (!group_.isHeld(i)) {
      loads_[i] = worldLoads_[inWorld(i)];
    }
  }
}

double GroupLoads::acceleration(const GroupState& at) {
  find(at);
  double largest = isGravitySloping(group_.world()) ? gravityScale(group_.world()) : 0;
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    if (!group_.isHeld(i)) {
      const MassProperties& mass = group_.body(i).mass;
      const double turning =
          loads_[i].torque.norm() * mass.inverseInertiaBody.maxCoeff() * radiusOf(group_.body(i));
      largest = std::max(largest, mass.inverseMass * loads_[i].force.norm() + turning);
    }
  }
  return largest;
}

double GroupLoads::pull(const GroupState& at) {
  const double gravity = std::max(gravityScale(group_.world()), drivenAcceleration(group_.bodies()));
  return vary() ? std::max(gravity, acceleration(at)) : gravity;
}

}  // namespace careen
