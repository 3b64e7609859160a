#pragma once

#include "trajectory/trajectory.h"

namespace careen {

/// Consistency checks of a loaded run, so that nothing later has to check: a file can be intact and yet
/// inconsistent. InputError names the fault in the form: "has a body 'crate' whose mass is -1 kg, …".

/// Checks motions and impacts, so that drawing or measuring them terminates.
void checkMotions(const Trajectory& run);

/// checkMotions(), plus the world, the stage, and their agreement.
void checkRun(const Trajectory& run);

}  // namespace careen
