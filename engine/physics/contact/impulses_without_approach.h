#pragma once

#include <optional>
#include <vector>

#include "physics/contact/found_contacts.h"
#include "physics/contact/group_step.h"
#include "physics/contact/implicit_step.h"

namespace careen {

/// A step that is a moment, in which impulses without approach act: of a jam.
struct JammedMoment {
  GroupStep step;                  ///< at its start bodies have the velocities after the impulses
  std::vector<ClosedContact> law;  ///< forces that give the impulses in its length
  double part = 0;                 ///< [1] of the step that was tried
  double change = 0;               ///< [m/s] of a velocity in that step, at most
};

/// Where the impulses of a step stay finite as it shrinks, they are impulses without approach: they act in a
/// moment, and the step becomes that moment. Else it would go on with the velocities before while they grow.
/// `known`: forces to start from. Nothing if the impulses shrink with the step.
std::optional<JammedMoment> jammedMomentOf(const GroupStep& step, const FoundContacts& contacts,
                                           const std::vector<ClosedContact>& known, ImplicitStep& equations);

}  // namespace careen
