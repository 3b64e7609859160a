#pragma once

#include "core/math/pose.h"

namespace careen {

/// Distance of two poses of a body. Infinite if a number is not finite.
struct PoseDifference {
  double position = 0;  ///< [m] of the centre of mass
  double angle = 0;     ///< [rad] of the rotation from one to the other
  double relative = 0;  ///< [1] the larger of position / half diagonal of the body, and angle

  /// Replaces each field by the larger of both.
  void include(const PoseDifference& other);
};
PoseDifference differenceOf(const Pose& a, const Pose& b, double halfDiagonal);

/// A relative difference beyond which two runs are unrelated: chaos has taken over.
inline constexpr double kHorizonDifference = 0.01;

/// The angle [rad] of the rotation from one orientation to the other.
double angleBetween(const Mat3& a, const Mat3& b);

}  // namespace careen
