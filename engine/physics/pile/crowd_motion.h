#pragma once

#include "physics/pile/crowd_contacts.h"
#include "physics/pile/crowd_impulses.h"
#include "physics/pile/crowd_loads.h"
#include "physics/pile/crowd_members.h"
#include "physics/pile/crowd_memory.h"

namespace careen {

/// Moves members by the step, at the velocities found, which are those of its middle: those without contact
/// impulse follow their parabola, the others a straight line.
void moveMembers(CrowdMembers& members, const CrowdLoads& loads, const CrowdImpulses& impulses);

/// A member is untouched while no contact point is near it.
void countUntouched(const CrowdMembers& members, CrowdContacts& contacts, CrowdMemory& memory);

/// [rad/s] What an angular impulse [N m s] changes.
Vec3 spinBy(const PileBody& body, const Vec3& angularImpulse);

/// Of a solver: impulses change L at the attitude at which they were solved.
void takeVelocity(PileBody& body, const Vec3& velocity, const Vec3& omega);

}  // namespace careen
