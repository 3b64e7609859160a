#pragma once

#include <cstddef>
#include <vector>

#include "trajectory/pose_table.h"
#include "trajectory/trajectory.h"

namespace careen {

/// [s] k · every, from 0 to the end of the run. InputError if `every` is not positive and finite, or makes
/// more than 1e8 samples.
std::vector<double> sampleTimes(const Trajectory& trajectory, double every);

/// A body's row in a table of poses; of the two quaternions of its orientation the one whose first non-zero
/// component is positive. PoseRow::box is its index in the world.
PoseRow poseRow(const Trajectory& trajectory, std::size_t body, double time);

}  // namespace careen
