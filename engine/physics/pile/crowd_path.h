#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "physics/geometry/box_at.h"
#include "physics/motion/hermite_step.h"
#include "physics/pile/crowd_contacts.h"
#include "physics/pile/crowd_loads.h"
#include "physics/pile/crowd_members.h"

namespace careen {

/// Space that members of a crowd take.
struct CrowdExtent {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::max());
  void include(const Vec3& center, double radius);
};

/// Where members of a crowd were and can be: their motion within the last step.
class CrowdPath {
 public:
  CrowdPath(const CrowdMembers& members, const CrowdLoads& loads, const CrowdContacts& contacts)
      : members_(members), loads_(loads), contacts_(contacts) {}

  /// Where the step of one began and ended. Where something pushed it, it moves straight and both ends have
  /// the mean velocity; that with which it came, only its begin.
  StepEnd begin(std::size_t place) const;
  StepEnd beginAsItCame(std::size_t place) const;
  StepEnd end(std::size_t place) const;
  /// By place, of the last step: whether its velocity changed by more than lasting forces do, or that of one
  /// which it pushed, directly or through others.
  std::vector<char> changedSuddenly() const;

  /// The space that members that are awake or asleep can reach within that time [s]; that the last step took.
  CrowdExtent extent(double length) const;
  CrowdExtent swept() const;
  /// Whether a member came that near [m] to another body, as far as that can be said before a search.
  bool cameNear(std::size_t place, const Body& body, const Pose& pose, double distance) const;

 private:
  Vec3 meanSpin(std::size_t place) const;
  bool changesSuddenly(std::size_t place) const;

  const CrowdMembers& members_;
  const CrowdLoads& loads_;
  const CrowdContacts& contacts_;
};

}  // namespace careen
