#pragma once

#include <vector>

#include "physics/impact/impact_law.h"
#include "physics/world/world.h"

namespace careen {

/// Adds a contact for every corner of the body that touches a wall within kSimultaneous at that time [s]. `index` is the
/// body's among those of the impact, `firstWall` that of the first wall. Returns the largest penetration of a
/// corner into a wall [m], 0 if none penetrates.
double addWallContacts(const World& world, const Body& body, const Pose& pose, int index, int firstWall,
                       std::vector<ImpactContact>& contacts, double time = 0);

}  // namespace careen
