#pragma once

#include <utility>
#include <vector>

#include "core/math/linear_algebra.h"
#include "trajectory/trajectory.h"

namespace careen {

/// Whether a wall is a floor or a ceiling.
bool isLevel(const Vec3& normal);
/// Horizontal and upward directions on a wall; on a level one, x and y up to their signs.
std::pair<Vec3, Vec3> directionsOn(const Vec3& normal);
/// The same of a wall at a moment [s]: of one that moves by itself those of its start, turned with it.
std::pair<Vec3, Vec3> directionsOn(const Plane& wall, double time);

/// Bounds of places on a wall [m], in world coordinates along its two directions; empty if min > max.
struct WallReach {
  Vec2 min = Vec2::Constant(1);
  Vec2 max = Vec2::Constant(-1);

  bool isEmpty() const { return min.x() > max.x(); }
  void add(const Vec2& place, double radius);
};

/// How far boxes go along each wall of the stage while they are near it, in the film: up to half the scene's
/// size away. Samples the film at 60 or more evenly spaced moments. None if a room bounds the walls.
std::vector<WallReach> wallReachesOf(const Trajectory& run);

}  // namespace careen
