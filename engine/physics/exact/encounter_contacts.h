#pragma once

#include <cstddef>
#include <vector>

#include "physics/exact/bodies.h"
#include "physics/exact/encounter.h"

namespace careen {

/// Finds where its bodies touch each other and walls, and along which of their axes they are kept apart.
/// Returns the deepest penetration of a wall [m].
double findContacts(const Bodies& bodies, Encounter& encounter);

/// The joints' conditions that hold, and those whose gap is closed, as the bodies are after the encounter.
std::vector<ImpactContact> closedJoints(const Encounter& encounter);

/// Of the axes of a contact that persists, those that its bodies approach, at that velocity [m/s] of a's
/// point relative to b's, keep nothing apart from now on. If one direction is left, the contact is one along
/// it; if it was another one, it does not persist but is met anew.
void choose(const Bodies& bodies, Encounter& encounter, std::size_t contact, const Vec3& velocity);

}  // namespace careen
