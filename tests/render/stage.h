#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "image/picture.h"
#include "physics/world/body.h"
#include "render/draw/renderer.h"
#include "render/gl/rendering_backend.h"
#include "render/look/lighting.h"
#include "scene/plan.h"
#include "scene/scene.h"
#include "trajectory/trajectory.h"

namespace careen {

// What tests of drawing share: small scenes in code, and colours worked out beside the engine.

inline SceneBox boxAt(const Vec3& position, const Vec3& halfExtents, const Color& color = {}) {
  SceneBox box;
  box.name = "box";
  box.halfExtents = halfExtents;
  box.mass = 1;
  box.pose.position = position;
  box.color = color;
  return box;
}

inline Wall wallAt(const Vec3& normal, double offset) {
  return {.name = "wall", .normal = normal, .offset = offset, .material = {}};
}

inline Camera cameraAt(const Vec3& eye, const Vec3& target, double fovDegrees) {
  return {.eye = eye, .target = target, .up = Vec3::UnitZ(), .fovDegrees = fovDegrees};
}

/// Boxes where the scene puts them.
inline std::vector<Pose> posesOf(const Scene& scene) {
  std::vector<Pose> poses;
  for (const SceneBox& box : scene.boxes) {
    poses.push_back(box.pose);
  }
  return poses;
}

/// A crate in a room open in front and above, as the default film has it.
inline Scene crateInRoom() {
  Scene scene;
  scene.name = "crate in a room";
  scene.duration = 1;
  scene.gravity = Vec3(0, 0, -9.81);
  scene.room.emplace();
  scene.room->min = Vec3(-3, -2, 0);
  scene.room->max = Vec3(3, 2, 3);
  scene.room->open = {false, false, true, false, false, true};
  scene.boxes.push_back(boxAt(Vec3(0, 0, 1), Vec3(0.5, 0.3, 0.2), Color{200, 85, 61}));
  scene.boxes[0].pose.worldFromBody =
      Quat(0.8, 0.2, 0.4, 0.4).normalized().toRotationMatrix();  // no face straight on
  scene.camera = cameraAt(Vec3(-1.5, -7, 3), Vec3(0, 0, 1.2), 38);
  return scene;
}

/// No library of any backend can be loaded.
inline ContextOptions nowhereToDraw() {
  ContextOptions options;
  options.osMesaLibrary = "libNoSuchMesa.so";
  options.eglLibrary = "libNoSuchEgl.so";
  return options;
}

/// Light from all around alike, none from any side: what is drawn has its own colour.
inline Lighting evenLighting(const Vec3& background = Vec3::Zero()) {
  return {.light = std::nullopt,
          .sky = Vec3::Ones(),
          .ground = Vec3::Ones(),
          .backgroundTop = background,
          .backgroundBottom = background};
}

/// So lit, and nothing done to the light on its way into the picture.
inline RenderOptions lit(const Lighting& lighting) {
  RenderOptions options;
  options.lighting = lighting;
  options.materials = Materials{.contactShade = 0, .shoulder = 1e9, .dither = 0};  // light stays as it is
  return options;
}

/// 8-bit sRGB of a linear value (IEC 61966-2-1).
inline int srgbFromLinear(double value) {
  const double clamped = std::clamp(value, 0.0, 1.0);
  const double encoded = clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1 / 2.4) - 0.055;
  return static_cast<int>(std::lround(255 * encoded));
}

inline std::array<int, 3> pixelAt(const Picture& picture, int x, int y) {
  const std::size_t place =
      static_cast<std::size_t>(y) * picture.rowBytes() + 3 * static_cast<std::size_t>(x);
  return {picture.rgb.at(place), picture.rgb.at(place + 1), picture.rgb.at(place + 2)};
}

/// A scene on a picture of this size [px].
inline RunSetup setupOf(Scene scene, int width, int height) {
  scene.picture.width = width;
  scene.picture.height = height;
  return setupOf(scene);
}

/// What becomes of a scene.
inline Trajectory runOf(const Scene& scene) { return record(setupOf(scene)); }

/// A run as it is shown on the scene's stage.
inline Trajectory shownAs(const Scene& scene, Trajectory run) {
  run.stage = stageOf(scene);
  return run;
}

/// The scene's first box drifts at a steady velocity for the scene's whole duration.
inline Trajectory drifting(const Scene& scene, const Vec3& velocity) {
  Trajectory trajectory;
  static_cast<RunSetup&>(trajectory) = setupOf(scene);
  trajectory.sceneText = scene.name;
  EulerStep motion;
  motion.start.pose = scene.boxes.at(0).pose;
  motion.start.velocity = velocity;
  trajectory.tracks.push_back({.segments = {{.start = 0, .motion = motion}}});
  return trajectory;
}

}  // namespace careen
