#pragma once

#include <string>
#include <vector>

#include "physics/world/body.h"
#include "scene/plan.h"
#include "scene/scene.h"
#include "trajectory/trajectory.h"

namespace careen {

// Small scenes in code, and what becomes of them.

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
  scene.settings.duration = 1;
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
