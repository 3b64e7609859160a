#pragma once

#include <string>

#include "physics/exact/exact_world.h"
#include "support/article_equations.h"
#include "support/exact_runs.h"

// Scenes of crowds, and their runs among the other groups of the event queue.

namespace careen::test {

inline constexpr double kTolerance = 3e-4;

inline Recorded crowdRun(const World& world, double duration, double tolerance = kTolerance, int above = 0) {
  Recorded run;
  run.motions.resize(world.bodies.size());
  Notes notes(run);
  const RunSettings settings{
      .duration = duration,
      .crowds = {.when = CrowdSettings::When::kAbove, .above = above, .tolerance = tolerance}};
  run.figures = ExactWorld(world, settings, notes).run({});
  return run;
}

inline World onARoughFloor(double friction, double restitution = 0) {
  World world;
  world.gravity = Vec3(0, 0, -9.81);
  world.walls = {wall("floor", Vec3(0, 0, 1), 0, restitution)};
  world.walls[0].material.friction = friction;
  return world;
}

inline Body ofMaterial(Body body, double friction, double restitution = 0) {
  body.material = {.restitution = restitution, .friction = friction};
  return body;
}

// Layers that tumble onto each other.
inline World layers() {
  World world = onARoughFloor(0.5);
  for (int k = 0; k < 40; ++k) {
    const Vec3 position(0.75 * (k % 3), 0.75 * (k / 3 % 3), 0.4 + 0.75 * (k / 9));
    const Vec3 spin(k % 5 - 2, k % 3 - 1, k % 4);
    world.bodies.push_back(ofMaterial(
        box("box-" + std::to_string(10 + k), Vec3(0.2, 0.2, 0.2), 1, position, Vec3::Zero(), spin, 0), 0.5));
  }
  return world;
}

}  // namespace careen::test
