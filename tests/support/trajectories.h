#pragma once

#include "physics/world/body.h"
#include "physics/world/method.h"
#include "trajectory/trajectory.h"

namespace careen {

/// Two boxes and a wall, made by hand: "drifter" moves at (2, 0, 0) m/s from x = 1 m without forces, is hit
/// at 0.5 s and returns; "anchor" stays at (0, 5, 0). Duration 1 s.
inline Trajectory driftAndReturn() {
  Trajectory trajectory;
  trajectory.sceneText = "{ \"a scene\": 1 }\n";
  trajectory.settings = {.method = Method::kListing1, .duration = 1.0, .dt = 0.5};
  trajectory.figures = {
      .energyChange = 0.1, .momentumChange = 1e-16, .orthogonality = 3e-16, .deepestPenetration = 1e-4};
  trajectory.world.walls = {{.name = "room-x", .normal = Vec3(1, 0, 0), .offset = -3, .material = {}},
                            {.name = "room+x", .normal = Vec3(-1, 0, 0), .offset = -2.1, .material = {}}};
  trajectory.stage.colors.resize(2);

  EulerStep out;
  out.start.pose.position = Vec3(1, 0, 0);
  out.start.velocity = Vec3(2, 0, 0);
  EulerStep back;
  back.start.pose.position = Vec3(2, 0, 0);
  back.start.velocity = Vec3(-2, 0, 0);
  back.start.angularMomentum = Vec3(0, 0, 1. / 3);
  const Vec3 halfExtents(0.1, 0.2, 0.3);
  trajectory.world.bodies.push_back({.name = "drifter",
                                     .halfExtents = halfExtents,
                                     .mass = solidBox(halfExtents, 2.0),
                                     .material = {},
                                     .initial = out.start});
  trajectory.tracks.push_back({.segments = {{.start = 0, .motion = out}, {.start = 0.5, .motion = back}}});
  Rest rest;
  rest.pose.position = Vec3(0, 5, 0);
  trajectory.world.bodies.push_back({.name = "anchor",
                                     .halfExtents = Vec3::Ones(),
                                     .mass = immovable(),
                                     .material = {},
                                     .initial = {.pose = rest.pose}});
  trajectory.tracks.push_back({.segments = {{.start = 0, .motion = rest}}});
  trajectory.impacts.push_back({.time = 0.5,
                                .a = {0},
                                .b = Partner::ofWall(1),
                                .point = Vec3(2.1, 0, 0),
                                .normal = Vec3(-1, 0, 0),
                                .approach = 2,
                                .impulse = 8,
                                .tangential = 0});
  return trajectory;
}

}  // namespace careen
