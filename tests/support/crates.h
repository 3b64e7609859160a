#pragma once

#include <string>

#include "physics/world/world.h"

// Boxes on a floor, for crowds.

namespace careen::test {

inline constexpr double kGravity = 9.81;

inline Body crate(const std::string& name, const Vec3& half, const Vec3& position, const Material& material,
                  double density = 1000) {
  Body body;
  body.name = name;
  body.halfExtents = half;
  body.mass = solidBox(half, density * 8 * half.prod());
  body.material = material;
  body.initial.pose.position = position;
  return body;
}

inline World floorWorld(const Material& material) {
  World world;
  world.gravity = Vec3(0, 0, -kGravity);
  world.walls.push_back({.name = "floor", .normal = Vec3::UnitZ(), .offset = 0, .material = material});
  return world;
}

inline bool sameBits(const BodyState& a, const BodyState& b) {
  return a.pose.position == b.pose.position && a.pose.worldFromBody == b.pose.worldFromBody &&
         a.velocity == b.velocity && a.angularMomentum == b.angularMomentum;
}

}  // namespace careen::test
