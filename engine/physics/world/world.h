#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/world/body.h"
#include "physics/world/control.h"
#include "physics/world/joint.h"

namespace careen {

/// What bounds a half-space: a point x is on the free side where normal·x > offset.
struct WallPlane {
  Vec3 normal = Vec3::UnitZ();  ///< [1] unit, points to the free side
  double offset = 0;            ///< [m]
};

/// Half-space obstacle. One that moves by itself has a frame whose origin is on it, and in which its normal
/// is `normal`; the axes are the world's at the start, but for its swinging. Its offset is not read then.
struct Wall {
  std::string name;
  Vec3 normal = Vec3::UnitZ();  ///< [1] unit, points to the free side
  double offset = 0;            ///< [m]
  Material material;
  Course course = {};  ///< of its frame, if it moves by itself
};

/// How a wall's frame moves at a moment [s]; that of one that is still is the world's.
Kinematics wallMotion(const Wall& wall, double time);
/// Where a wall is, given the pose of its frame; and at a moment [s].
inline WallPlane planeOf(const Wall& wall, const Pose& pose) {
  if (wall.course.empty()) {
    return {wall.normal, wall.offset};
  }
  const Vec3 normal = pose.worldFromBody * wall.normal;
  return {normal, dot(normal, pose.position)};
}
inline WallPlane planeAt(const Wall& wall, double time) { return planeOf(wall, wallMotion(wall, time).pose); }

/// The half-space of what has no extent, which nothing meets: the shape of the world where joints end in it.
const Wall& nowhere();

/// End of a spring: a point of a body, in the body's frame, or of the world.
struct SpringEnd {
  std::optional<int> body;
  Vec3 point = Vec3::Zero();  ///< [m]
};

/// Pulls its ends together with k (length − rest) + c · (rate of length), along the line between them.
struct Spring {
  SpringEnd from;
  SpringEnd to;
  double stiffness = 0;   ///< [N/m] k
  double damping = 0;     ///< [N s/m] c
  double restLength = 0;  ///< [m]
};

/// F = −linear · v, τ = −angular · ω.
struct Drag {
  double linear = 0;   ///< [N s/m]
  double angular = 0;  ///< [N m s]
};

/// Gravity [m/s²] at a moment [s].
struct GravityChange {
  double time = 0;
  Vec3 gravity = Vec3::Zero();
};

/// Between those moments: it is what it was at the last one, or runs straight from each to the next.
enum class GravityPath { kSteps, kLinear };

/// The simulated system: only what a scene's plan needs is in it; an empty list costs nothing.
struct World {
  Vec3 gravity = Vec3::Zero();                    ///< [m/s²] at `gravitySince`
  double gravitySince = 0;                        ///< [s] the start; of a world that changes, the last change
  std::vector<GravityChange> gravityChanges;      ///< after it; their times ascend
  GravityPath gravityPath = GravityPath::kSteps;  ///< constant after the last of them
  std::vector<Body> bodies;
  std::vector<Wall> walls;
  std::vector<Spring> springs;
  std::optional<Drag> drag;
  std::vector<Joint> joints;
  std::optional<Control> control;
  std::vector<std::pair<int, int>> apart;  ///< bodies that pass through each other, the lesser first; sorted
};

/// Whether a surface moves along itself: it may give energy. And whether something held moves by itself.
bool hasBelts(const World& world);
bool hasCourses(const World& world);
/// What of it does, for messages: fixed boxes, walls, or both.
std::string whatHasCourses(const World& world);
/// [m/s²] Gravity just after a moment [s], and its mean from one moment to another.
Vec3 gravityAt(const World& world, double time);
Vec3 meanGravity(const World& world, double from, double to);
/// [m/s²] The largest that it ever is; and until it changes next.
double mostGravity(const World& world);
double gravityScale(const World& world);
/// Whether it grows evenly until it changes next, how fast [m/s³], and what it is [m/s²] at a moment until
/// then; straight on after it.
bool isGravitySloping(const World& world);
Vec3 gravitySlope(const World& world);
Vec3 gravityNow(const World& world, double time);
/// Whether a body, by index, is an end of a joint.
bool isJointed(const World& world, int body);
/// Whether a joint that holds lets go one day, is driven, or has an effort that a control may change.
bool mayStillChange(const World& world, const Joint& joint);

/// Whether two bodies stop each other.
inline bool mayTouch(const World& world, int a, int b) {
  return world.apart.empty() || !std::binary_search(world.apart.begin(), world.apart.end(),
                                                    std::pair(std::min(a, b), std::max(a, b)));
}

}  // namespace careen
