#pragma once

#include <cstddef>
#include <span>

#include "render/view/camera.h"
#include "stage/camera.h"
#include "stage/time_map.h"
#include "trajectory/trajectory.h"

namespace careen {

/// The film time between the points that carry the path of a camera that follows a box [s]. Blows are spread
/// over twice of this before and after.
inline constexpr double kFollowStep = 0.2;

/// Where the camera is at every moment of a film: nothing but run, film time and aspect decide it.
class CameraPath {
 public:
  /// `clock` has keys. Keeps the run by reference.
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

/// A camera that stands still and has all boxes in its picture whenever the film shows them, and where
/// springs are held: as near as it can be, in the direction of cameraThatSees. Looks at moments spread evenly
/// over the film, at 60 at least.
Camera cameraThatFrames(const Trajectory& run, const TimeMap& clock, double aspect);

/// Between keys every coordinate of eye and target and the angle follow a cubic that takes on the keys'
/// values and turns round at keys alone (F. N. Fritsch, J. Butland, "A method for constructing local monotone
/// piecewise cubic interpolants", 1984): the speed does not jump, nothing overshoots, what is equal in two
/// keys stays so between them. Stands still before the first key and after the last, where it also starts and
/// ends its way at rest. There must be keys, in order.
CameraKey between(std::span<const CameraKey> keys, double time);

}  // namespace careen
