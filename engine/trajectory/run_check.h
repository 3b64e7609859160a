#pragma once

#include "trajectory/trajectory.h"

namespace careen {

/// Whether what a run says hangs together, so that nothing later has to ask: a file can be whole and yet make
/// no sense. InputError says what is wrong, as what the run has: "has a body 'crate' whose mass is -1 kg, …".

/// How bodies move and what they struck: whatever is drawn or measured of it comes to an end.
void checkMotions(const Trajectory& run);

/// That, the world, the stage, and that each agrees with the others.
void checkRun(const Trajectory& run);

}  // namespace careen
