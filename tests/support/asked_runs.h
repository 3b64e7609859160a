#pragma once

#include "physics/world/run_settings.h"
#include "trajectory/trajectory.h"

namespace careen::test {

constexpr double kG = 9.81;  ///< [m/s²] of the runs that are asked

/// The run of a world.
inline Trajectory runOf(const World& world, double duration, CrowdSettings crowds = {}) {
  return record(world, {.duration = duration, .crowds = crowds}, "");
}

}  // namespace careen::test
