#pragma once

#include <cstddef>
#include <vector>

#include "physics/contact/touching_group.h"
#include "physics/world/forces.h"

namespace careen {

/// What acts on the bodies of a group beside their contacts: gravity, springs, drag.
class GroupLoads {
 public:
  explicit GroupLoads(const TouchingGroup& group);

  /// Finds them at a state; `[body]` is what was found last.
  void find(const GroupState& at);
  const Load& operator[](std::size_t body) const { return loads_[body]; }
  /// Whether they depend on the state at all, or on time: springs and drag do, and gravity if it slopes.
  bool vary() const { return !worldStates_.empty() || isGravitySloping(group_.world()); }
  /// [m/s²] Largest acceleration by them at that state, corners included; or of gravity later, if it slopes.
  double acceleration(const GroupState& at);
  /// [m/s²] The scale of such accelerations: gravity's, or the largest where springs or drag act.
  double pull(const GroupState& at);

 private:
  const TouchingGroup& group_;
  std::vector<BodyState> worldStates_;  // for springs and drag, else empty
  std::vector<Load> loads_;             // by body of the group
  std::vector<Load> worldLoads_;
};

}  // namespace careen
