#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/math/linear_algebra.h"

namespace careen {

struct Camera {
  Vec3 eye = Vec3::Zero();     ///< [m]
  Vec3 target = Vec3::Zero();  ///< [m]
  Vec3 up = Vec3::UnitZ();     ///< [1] unit, not along the line of sight
  double fovDegrees = 40;      ///< [deg] vertical
};

/// Camera at a film time.
struct CameraKey {
  double time = 0;             ///< [s] of the film
  Vec3 eye = Vec3::Zero();     ///< [m]
  Vec3 target = Vec3::Zero();  ///< [m]
  double fovDegrees = 40;      ///< [deg] vertical
};

/// How the camera moves from its start. Keys and an orbit are mutually exclusive.
struct CameraMove {
  double orbitDegrees =
      0;  ///< [deg/s] in film time: the eye turns about target and up, by the right-hand rule
  std::optional<std::size_t> followed;  ///< box with which eye and target move
  std::vector<CameraKey> keys;          ///< in order of time; the first is the camera's start
};

}  // namespace careen
