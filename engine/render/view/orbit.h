#pragma once

#include "stage/camera.h"

namespace careen {

/// How far someone has turned a camera about its target, from where the film has it at the moment.
struct Orbit {
  double azimuth = 0;    ///< [rad] of the eye about up, by the right-hand rule
  double elevation = 0;  ///< [rad] of the eye, upward
  double distance = 1;   ///< [1] of the film's

  friend bool operator==(const Orbit&, const Orbit&) = default;
};

/// The camera turned so. It never comes nearer to looking along its up than kSteepest, or than the film's own
/// if that is steeper. Without any turn it is the film's, bit for bit.
Camera orbited(const Camera& film, const Orbit& orbit);

/// What is left of further turns where `film` is the camera: no more than orbited() follows, so that turning
/// back begins at once; and the distance within kNearest … kFarthest.
Orbit turned(const Orbit& orbit, const Camera& film, const Orbit& by);

inline constexpr double kSteepest = 1.55;  ///< [rad] elevation
inline constexpr double kNearest = 0.05;   ///< [1] of the film's distance
inline constexpr double kFarthest = 20;    ///< [1] likewise

}  // namespace careen
