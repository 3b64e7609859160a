#pragma once

#include <cstddef>
#include <span>

#include "stage/camera.h"
#include "stage/time_map.h"
#include "trajectory/trajectory.h"
#include "view/camera.h"

namespace careen {

/// Film time between the control points of the path of a camera that follows a box [s]. Impacts are smoothed
/// over twice this time before and after.
inline constexpr double kFollowStep = 0.2;

/// The camera at every moment of a film; depends only on run, film time and aspect.
class CameraPath {
 public:
  /// `clock` has keys. Keeps a reference to the run.
  CameraPath(const Trajectory& run, TimeMap clock, double aspect);

  bool hasKeys() const { return !move_.keys.empty(); }
  /// Film time [s].
  Camera at(double filmTime) const;

 private:
  Vec3 followedCentre(double filmTime) const;
  Vec3 followedSmoothly(double filmTime) const;

  const CameraMove& move_;
  const Trajectory& run_;
  TimeMap clock_;
  Camera start_;
  Vec3 followedStart_ = Vec3::Zero();
};

/// A fixed camera that sees all boxes at all times of the film, and the fixed ends of springs: as near as
/// possible, in the direction of cameraThatSees. Samples the film at 60 or more evenly spaced moments.
Camera cameraThatFrames(const Trajectory& run, const TimeMap& clock, double aspect);

/// Monotone piecewise cubic interpolation of every coordinate of eye and target and the angle (F. N. Fritsch,
/// J. Butland, "A method for constructing local monotone piecewise cubic interpolants", 1984): the velocity
/// is continuous, extrema occur only at keys, without overshoot, and values equal in two keys stay constant
/// between them. Or as the easing has it. Constant before the first key and after the last, with zero
/// velocity at both. `keys` must be sorted and not empty.
CameraKey between(std::span<const CameraKey> keys, double time, Easing easing = Easing::kSmooth);

}  // namespace careen
