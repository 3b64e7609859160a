#pragma once

#include "physics/world/world.h"

namespace careen {

/// How far two bodies are from what a joint allows, from their places alone.
struct JointGap {
  /// [m] The larger of two: how far apart its points are, of a slider across its axis, of a rod or rope
  /// beyond its length; and the turn that its axes are misaligned by, as the way of the smaller body's
  /// corners.
  double open = 0;
  double beyond = 0;    ///< [m] how far its coordinate is beyond its limits, an angle likewise
  double rounding = 0;  ///< [m] of both
};

/// Poses of the bodies of both ends; anything for the world.
JointGap jointGapOf(const World& world, const Joint& joint, const Pose& from, const Pose& to);

}  // namespace careen
