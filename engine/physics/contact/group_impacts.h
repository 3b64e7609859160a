#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "physics/contact/found_contacts.h"
#include "physics/contact/implicit_step.h"
#include "physics/impact/impact_law.h"

namespace careen {

/// An impact of a group of bodies: one of its contacts.
struct GroupImpact {
  ImpactContact contact;  ///< its bodies are indices into the group
  ImpactShare share;
  double cause = 0;  ///< [m/s] the fastest approach in the impact
};

/// Impacts at the start of a time step, at all contacts of the bodies that they reach.
class GroupImpacts {
 public:
  /// The equations must outlive it.
  explicit GroupImpacts(ImplicitStep& equations) : equations_(equations) {}

  void clear() { impacts_.clear(); }
  /// Impacts until no closed contact approaches; contacts are followed to the state. Where bodies accelerated
  /// by `acceleration` [m/s²] would bounce no higher than counts, without restitution.
  void resolve(GroupState& state, FoundContacts& contacts, double acceleration);
  /// The impulses of the contacts `law` in `h` [s] are those of an impact without approach, which changes
  /// velocities by `change` [m/s].
  void addWithoutApproach(const FoundContacts& contacts, std::span<const ClosedContact> law, double h,
                          double change);
  /// Forgets those that change no velocity by more than that [m/s], or have no faster cause.
  void keepLarger(double speed);

  const std::vector<GroupImpact>& list() const { return impacts_; }
  /// Of the impacts since it was last asked.
  ContactResiduals takeResiduals() { return std::exchange(residuals_, {}); }

 private:
  struct Struck {  // the contacts in an impact
    std::vector<ContactFeature> features;
    std::vector<ImpactContact> contacts;
    double fastest = 0;  // [m/s] approach
    bool bounces = false;
  };

  Struck struckAt(const GroupState& state, const FoundContacts& contacts, double acceleration) const;
  bool resolveOnce(GroupState& state, const FoundContacts& contacts, double acceleration);
  void bounce(GroupState& state, std::span<const ImpactContact> contacts, std::span<ImpactShare> shares);
  bool compress(GroupState& state, const Struck& struck, std::span<ImpactShare> shares);

  ImplicitStep& equations_;
  std::vector<GroupImpact> impacts_;
  ContactResiduals residuals_;
};

}  // namespace careen
