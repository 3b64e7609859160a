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

/// Where the camera is at a moment of the film.
struct CameraKey {
  double time = 0;             ///< [s] of the film
  Vec3 eye = Vec3::Zero();     ///< [m]
  Vec3 target = Vec3::Zero();  ///< [m]
  double fovDegrees = 40;      ///< [deg] vertical
};

/// How the camera moves from where it starts. Keys and an orbit exclude each other.
struct CameraMove {
  double orbitDegrees = 0;  ///< [deg/s] of the film: the eye about target and up, by the right-hand rule
  std::optional<std::size_t> followed;  ///< box that eye and target go along with
  std::vector<CameraKey> keys;          ///< in order of time; the first is where the camera starts
};

}  // namespace careen
