#pragma once

#include <span>
#include <vector>

#include "physics/world.h"

namespace careen {

/// How far two sets of poses of the same world lie apart: the worst of its bodies that can move. Infinite if
/// a number is not finite.
struct PoseDifference {
  double position = 0;  ///< [m] of a centre of mass
  double angle = 0;     ///< [rad] of the turn from one to the other
  double relative = 0;  ///< [1] the larger of position / half diagonal of that body, and angle
};
PoseDifference differenceOf(const World& world, std::span<const BodyState> a, std::span<const BodyState> b);

/// Bodies at these poses, still.
std::vector<BodyState> withPoses(std::span<const Pose> poses);

/// The turn [rad] that leads from one orientation to the other.
double angleBetween(const Mat3& a, const Mat3& b);

}  // namespace careen
