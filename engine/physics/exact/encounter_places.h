#pragma once

#include "physics/exact/bodies.h"
#include "physics/exact/encounter.h"

namespace careen {

/// Gaps within this many touching tolerances are projected to zero together: the closing of a contact is
/// located to a few of them.
inline constexpr double kAligned = 64;

/// Position correction of touching bodies, which steps place only to the tolerance: projects the gaps of
/// existing contacts, new contacts and penetrations left by a time step to zero, by the least displacement.
/// Changes the states before and after the encounter alike.
void alignPlaces(const Bodies& bodies, const Event& event, Encounter& encounter);

}  // namespace careen
