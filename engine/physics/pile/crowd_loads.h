#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "physics/pile/crowd_members.h"
#include "physics/pile/crowd_memory.h"
#include "physics/world/forces.h"

namespace careen {

/// Forces on the members of a crowd other than those of contact: gravity, springs, drag.
class CrowdLoads {
 public:
  CrowdLoads(const CrowdMembers& members, const CrowdMemory& memory);

  /// That body of the world is a member.
  void limitBySprings(std::size_t listed);
  /// [s] With the springs of the members, and those of their joints.
  double longestStep() const;

  /// In the middle of the step, where gravity is its mean.
  void find();
  /// Beside gravity; in the last step.
  bool any() const { return !loads_.empty(); }
  const std::vector<Load>& ofStep() const { return loads_; }
  /// [m/s²] In this step and in that before.
  Vec3 acceleration(std::size_t place) const;
  Vec3 accelerationBefore(std::size_t place) const;
  /// [N m] Likewise.
  Vec3 torque(std::size_t place) const;
  Vec3 torqueBefore(std::size_t place) const;
  /// [m/s] From where it had its velocity to where it is.
  Vec3 halfKick(std::size_t place) const { return members_[place].behind * acceleration(place); }

 private:
  double mobilityOf(const Joint& joint) const;
  void limit(double stiffness, double damping, double mobility);

  const CrowdMembers& members_;
  const CrowdMemory& memory_;
  double longestStep_ = std::numeric_limits<double>::infinity();
  std::vector<BodyState> states_;  // of the world
  std::vector<Load> loads_;        // by index in the world
  Vec3 gravity_;                   // [m/s²] in the step
};

}  // namespace careen
