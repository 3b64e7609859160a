#include "physics/compared/collision1997.h"

#include <algorithm>
#include <cstddef>

#include "physics/compared/impulse.h"
#include "physics/world/gap.h"
#include "physics/world/kinematics.h"

namespace careen {
namespace {

/// Tests one corner against all walls; false once a corner penetrates.
bool lookAtCorner(const std::vector<Wall>& walls, BodyIndex body, const BodyState& state, const Vec3& omega,
                  const Vec3& cornerBody, CornerCheck& check) {
  const Vec3 point = state.pose.worldPoint(cornerBody);
  // Not A r̄: the impulse depends on the point only, and both must compute the same speed to the last bit, or
  // a corner stopped in one still moves in the other.
  const Vec3 r = point - state.pose.position;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const double distance = gap(walls[w], point);
    if (distance >= kTouchingDepth) {
      continue;
    }
    const CornerAtWall here{body, w, point, distance};
    check.deepest = std::max(check.deepest, -distance);
    if (distance < -kTouchingDepth) {
      check.state = CornerState::kPenetrating;
      check.corner = here;
      return false;
    }
    if (dot(walls[w].normal, pointVelocity(state.velocity, omega, r)) < 0) {
      check.state = CornerState::kColliding;
      check.corner = here;
    }
  }
  return true;
}

}  // namespace

CornerCheck checkCorners(const World& world, std::span<const BodyState> states) {
  CornerCheck check;
  if (world.walls.empty()) {
    return check;
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Body& body = world.bodies[i];
    if (isImmovable(body.mass)) {
      continue;
    }
    const Vec3 omega = angularVelocity(body.mass, states[i]);
    for (int c = 0; c < body.cornerCount(); ++c) {
      if (!lookAtCorner(world.walls, BodyIndex{static_cast<int>(i)}, states[i], omega, corner(body, c),
                        check)) {
        return check;
      }
    }
  }
  return check;
}

ResolvedCorner resolveCorner(const World& world, const CornerAtWall& corner, double time,
                             std::span<BodyState> states) {
  const auto index = static_cast<std::size_t>(corner.body.value);
  const Body& body = world.bodies[index];
  const Wall& wall = world.walls[corner.wall];
  const MassProperties wallMass = immovable();
  BodyState wallState;
  const CollidingBody box{body.mass, states[index]};
  const CollidingBody obstacle{wallMass, wallState};

  const double restitution = touching(body.material, wall.material).restitution;
  const double approach = -normalVelocity(box, obstacle, corner.point, wall.normal);
  const double impulse = collisionImpulse(box, obstacle, corner.point, wall.normal, restitution);
  applyImpulse(box, corner.point, impulse * wall.normal);
  applyImpulse(obstacle, corner.point, -impulse * wall.normal);
  return {.impact = {.time = time,
                     .a = corner.body,
                     .b = Partner::ofWall(corner.wall),
                     .point = corner.point,
                     .normal = wall.normal,
                     .approach = approach,
                     .impulse = impulse},
          .energyChange = impactEnergyChange(approach, impulse, restitution)};
}

}  // namespace careen
