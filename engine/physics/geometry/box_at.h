#pragma once

#include "core/math/linear_algebra.h"
#include "core/math/pose.h"

namespace careen {

/// A box at a place, as an argument: a view of its pose and size, not to be stored.
struct BoxAt {
  const Pose& pose;
  const Vec3& halfExtents;  ///< [m] half sizes along the box's axes
};

}  // namespace careen
