#pragma once

#include <vector>

#include "audit/findings.h"
#include "trajectory/trajectory.h"

namespace careen {

/// Follows each body of a table from row to row. Where nothing can have touched it, because nothing was as
/// near as it could come, it must have flown: an impulse there is unexplained, and places and attitudes
/// follow from velocities. Where it can have touched one thing only, restitution and friction are held to
/// what both rows allow, see encounter.h. Small excesses of many rows add up.
///
/// Not looked at: bodies under springs, joints and drag, bodies that may have touched several things at once,
/// boxes without rows at the times of the others.
///
/// `near` [m]: what is no farther apart may push each other; `part` [1]: speeds may be off by it;
/// `fallingSpeeds` [m/s]: of each body, see seams.h.
///
/// Returns which bodies were followed.
std::vector<char> checkBetweenRows(const Trajectory& run, double near, double part,
                                   const std::vector<double>& fallingSpeeds, Findings& findings);

}  // namespace careen
