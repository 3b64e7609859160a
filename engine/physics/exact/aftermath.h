#pragma once

#include "physics/exact/bodies.h"
#include "physics/exact/encounter.h"

namespace careen {

/// What becomes of the bodies of an encounter after its impact: Flight, Rest, or an island of those in
/// contact. Contacts that neither approach nor part persist, and those whose next hops are too short to
/// follow. Bodies whose contacts change too often go on by time steps.
void settle(Bodies& bodies, Encounter& encounter);

/// [m/s] of a contact's points after the impact.
struct Parting {
  double speed = 0;              ///< rate of the gap
  double rounding = 0;           ///< up to this it counts as zero
  Vec3 velocity = Vec3::Zero();  ///< of a's point relative to b's
};
Parting partingAt(const Encounter& encounter, std::size_t contact);

}  // namespace careen
