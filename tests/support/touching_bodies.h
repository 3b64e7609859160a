#pragma once

#include <utility>
#include <vector>

#include "physics/contact/touching_group.h"
#include "support/exact_runs.h"

namespace careen {

/// Its bodies, then its walls.
inline std::vector<TouchingBody> touching(const World& world) {
  std::vector<TouchingBody> bodies;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    bodies.push_back({.body = &body,
                      .index = static_cast<int>(i),
                      .position = body.initial.pose.position,
                      .worldFromBody = Quat(body.initial.pose.worldFromBody),
                      .velocity = body.initial.velocity});
    if (!bodies.back().isHeld()) {
      bodies.back().angularVelocityBody = body.mass.inverseInertiaBody.cwiseProduct(
          body.initial.pose.worldFromBody.transpose() * body.initial.angularMomentum);
    }
  }
  for (const Wall& wall : world.walls) {
    bodies.push_back(touchingBody(wall));
  }
  return bodies;
}

/// Gravity of 10 m/s² and a floor at z = 0.
inline World floorWith(double friction, double restitution) {
  World world;
  world.gravity = Vec3(0, 0, -10);
  world.walls.push_back({.name = "floor",
                         .normal = Vec3::UnitZ(),
                         .offset = 0,
                         .material = {.restitution = restitution, .friction = friction}});
  return world;
}

/// A cube of 0.2 m and 1 kg, its middle at that height [m] above it.
inline World cubeAbove(double height, const Vec3& velocity = Vec3::Zero(), double friction = 0,
                       double restitution = 0) {
  World world = floorWith(friction, restitution);
  world.bodies.push_back(box("cube", Vec3(0.1, 0.1, 0.1), 1, Vec3(0, 0, height), velocity, Vec3::Zero(), 0));
  return world;
}

/// The corners of a body that are below its middle, at the first wall.
inline std::vector<ContactFeature> lowerCorners(const World& world, int body = 0, double friction = 0) {
  std::vector<ContactFeature> features;
  for (int k = 0; k < kCorners; ++k) {
    const Vec3 at = corner(world.bodies[static_cast<std::size_t>(body)].halfExtents, k);
    if (at.z() < 0) {
      features.push_back({.a = body,
                          .b = static_cast<int>(world.bodies.size()),
                          .onA = at,
                          .material = {.friction = friction}});
    }
  }
  return features;
}

/// The bodies of a world as a group.
struct GroupOf {
  explicit GroupOf(World of)
      : world(std::move(of)), bodies(touching(world)), group(world, bodies), state(group.state()) {}
  GroupOf(const GroupOf&) = delete;
  GroupOf& operator=(const GroupOf&) = delete;

  World world;
  std::vector<TouchingBody> bodies;
  TouchingGroup group;
  GroupState state;
};

}  // namespace careen
