#pragma once

#include <string>

#include "trajectory/pose_table.h"

namespace careen {

/// Reads a table of poses from NPZ, which is a ZIP archive of .npy files; see readPoseTable(). What
/// encodeNpz() writes beside poses is not read: `units`, `joint`, and what begins with `impact_`, `joint_` or
/// `energy_`. InputError names file, array and row.
PoseTable readPoseArrays(const std::string& bytes, const std::string& name);

}  // namespace careen
