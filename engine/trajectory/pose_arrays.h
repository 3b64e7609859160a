#pragma once

#include <string>

#include "trajectory/pose_table.h"

namespace careen {

/// Reads a table of poses from NPZ, which is a ZIP archive of .npy files; see readPoseTable(). Arrays named
/// `units` or beginning with `impact_` are not read. InputError names file, array and row.
PoseTable readPoseArrays(const std::string& bytes, const std::string& name);

}  // namespace careen
