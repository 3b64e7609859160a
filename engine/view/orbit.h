#pragma once

#include "stage/camera.h"

namespace careen {

/// Rotation of a camera about its target by the user, relative to the film's current camera.
struct Orbit {
  double azimuth = 0;    ///< [rad] of the eye about `up`, by the right-hand rule
  double elevation = 0;  ///< [rad] of the eye, upward
  double distance = 1;   ///< [1] relative to the film's

  friend bool operator==(const Orbit&, const Orbit&) = default;
};

/// The rotated camera. Its elevation is limited to kSteepest, or the film's own if that is steeper. Without
/// rotation it is the film's camera, bit for bit.
Camera orbited(const Camera& film, const Orbit& orbit);

/// `orbit` rotated further by `by`, with `film` as the camera: limited to what orbited() applies, so that
/// turning back takes effect at once, and the distance to kNearest … kFarthest.
Orbit turned(const Orbit& orbit, const Camera& film, const Orbit& by);

inline constexpr double kSteepest = 1.55;  ///< [rad] elevation
inline constexpr double kNearest = 0.05;   ///< [1] of the film's distance
inline constexpr double kFarthest = 20;    ///< [1] likewise

}  // namespace careen
