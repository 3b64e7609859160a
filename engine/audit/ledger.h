#pragma once

#include <cstddef>
#include <vector>

#include "audit/findings.h"
#include "audit/groups.h"
#include "audit/samples.h"
#include "trajectory/trajectory.h"

namespace careen {

/// Balances of linear momentum, angular momentum and energy of every group, from each moment to the next.
///
/// What a group has at a moment must be what it had at the last one, plus what gravity, drag and springs
/// gave, plus the recorded impulses of walls and immovable bodies, plus what the walls that it lies on may
/// have given: no more than a sum of forces away from them with Coulomb friction. Energy may only fall, and
/// only where restitution, friction, drag or damping can take it. An excess is carried on: many small ones
/// add up.
///
/// The angular momentum of a group that lies on walls is balanced only about their common normal, and only if
/// they are without friction: where the forces act is not recorded. A group that lies on an immovable body is
/// not balanced meanwhile, and nor is one that a joint holds to it or to the world; its energy is, as joints
/// do no work: but limits and ropes may take some.
///
/// A wall whose surface moves along itself does work: that of its friction, which the group's momentum tells.
/// While a group touches surfaces that move differently, one that turns, or a box whose surface moves, its
/// energy may rise. Where gravity changes, or slopes, the group has so much more by that.
///
/// `fallingSpeeds` [m/s]: of each body, see seams.h.
void checkBalances(const Trajectory& run, const Samples& samples, const std::vector<ExchangeGroup>& groups,
                   const std::vector<double>& fallingSpeeds, Findings& findings);

}  // namespace careen
