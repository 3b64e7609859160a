#pragma once

#include "physics/pile/crowd_contacts.h"
#include "physics/pile/crowd_members.h"
#include "physics/pile/solver.h"

namespace careen {

/// Adds the second order of gaps, what points of turning bodies leave their tangents by within a step, to the
/// bounds of rows, once after they were loaded, at the velocities found so far, and puts on the list those
/// that it changes; returns whether there are any.
bool curveGaps(const CrowdMembers& members, CrowdContacts& contacts, PileSolver& solver);

}  // namespace careen
