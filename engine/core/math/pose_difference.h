#pragma once

#include "core/math/pose.h"

namespace careen {

/// How far two poses of a body lie apart. Infinite if a number is not finite.
struct PoseDifference {
  double position = 0;  ///< [m] of the centre of mass
  double angle = 0;     ///< [rad] of the turn from one to the other
  double relative = 0;  ///< [1] the larger of position / half diagonal of the body, and angle

  /// Becomes the larger of each.
  void include(const PoseDifference& other);
};
PoseDifference differenceOf(const Pose& a, const Pose& b, double halfDiagonal);

/// A relative difference beyond which two runs have nothing to do with each other: chaos has taken over.
inline constexpr double kHorizonDifference = 0.01;

/// The turn [rad] that leads from one orientation to the other.
double angleBetween(const Mat3& a, const Mat3& b);

}  // namespace careen
