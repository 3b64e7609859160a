#pragma once

#include "physics/exact/bodies.h"
#include "physics/exact/encounter.h"

namespace careen {

/// The impact at the contacts of an encounter, by the law of resolveImpact: the states after it, and the
/// share of each contact. The flights of its bodies end.
void resolve(Bodies& bodies, Encounter& encounter);

/// Records the contacts that had an impulse.
void record(Bodies& bodies, const Encounter& encounter);

}  // namespace careen
