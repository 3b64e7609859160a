#pragma once

#include <vector>

#include "physics/impact/impact_law.h"
#include "physics/world/world.h"

namespace careen {

/// Adds a contact for every corner of the body that touches a wall within kSimultaneous. `index` is the
/// body's among those of the impact. Returns how deep [m] the deepest corner lies in a wall, 0 if none does.
double addWallContacts(const World& world, const Body& body, const Pose& pose, int index,
                       std::vector<ImpactContact>& contacts);

}  // namespace careen
