#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "core/math/linear_algebra.h"

namespace careen {

struct Camera {
  Vec3 eye = Vec3::Zero();     ///< [m]
  Vec3 target = Vec3::Zero();  ///< [m]
  Vec3 up = Vec3::UnitZ();     ///< [1] unit, not along the line of sight
  double fovDegrees = 40;      ///< [deg] vertical
  Vec2 beside = Vec2::Zero();  ///< [m] the eye is so far to the right of there, and above
  double sharpAt = 1;  ///< [m] along the line of sight: what is there stays where it is for any of these
};

/// Camera at a film time.
struct CameraKey {
  double time = 0;             ///< [s] of the film
  Vec3 eye = Vec3::Zero();     ///< [m]
  Vec3 target = Vec3::Zero();  ///< [m]
  double fovDegrees = 40;      ///< [deg] vertical
};

/// How the camera goes from key to key.
enum class Easing {
  kSmooth,  ///< along monotone cubics, from rest to rest
  kLinear,
  kCut,  ///< not at all: it stays, and is at the next key when its time has come
};
inline constexpr std::array<std::string_view, 3> kEasings = {"smooth", "linear", "cut"};

/// What a lens makes sharp: what is nearer or farther is blurred. The film's pictures are then means of
/// several, seen from points all over the lens.
struct Focus {
  double fStop = 0;  ///< [1] focal length over the lens' diameter; the picture is 24 mm high
  std::optional<double> distance = {};   ///< [m] along the line of sight
  std::optional<std::size_t> body = {};  ///< whose centre it is; absent, and no distance: the target
  int samples = 32;                      ///< 1 … kMostShutterSamples
};

/// How the camera moves from its start. Keys and an orbit are mutually exclusive.
struct CameraMove {
  double orbitDegrees =
      0;  ///< [deg/s] in film time: the eye turns about target and up, by the right-hand rule
  std::optional<std::size_t> followed;  ///< box with which eye and target move
  std::vector<CameraKey> keys;          ///< in order of time; the first is the camera's start
  Easing easing = Easing::kSmooth;
};

}  // namespace careen
