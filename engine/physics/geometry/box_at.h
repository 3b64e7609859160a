#pragma once

#include <array>

#include "core/math/linear_algebra.h"
#include "core/math/pose.h"

namespace careen {

/// A box at a place, as an argument: a view of its pose and size, not to be stored.
struct BoxAt {
  const Pose& pose;
  const Vec3& halfExtents;  ///< [m] half sizes along the box's axes
};

/// Which of two boxes plays the part of a where both may: whichever is smaller, else nearer to the origin. It
/// does not follow from their names, nor change in mirrors and units; boxes that are equal in both stay as
/// they are listed.
inline bool comesFirst(BoxAt x, BoxAt y) {
  const std::array<double, 2> ofX{x.halfExtents.squaredNorm(), x.pose.position.squaredNorm()};
  const std::array<double, 2> ofY{y.halfExtents.squaredNorm(), y.pose.position.squaredNorm()};
  return ofX < ofY;
}

}  // namespace careen
