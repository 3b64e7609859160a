#include "physics/pile/belts.h"

#include "physics/pile/index.h"

namespace careen {

Moving motionOfBelt(const CrowdMembers& members, const PileManifold& manifold, const ContactFrame& frame,
                    const PilePoint& point) {
  const Vec3& n = frame.normal;
  const bool isOfB = members[manifold.b].held();
  const PileBody& held = members[isOfB ? manifold.b : manifold.a];
  if (held.isDriven()) {
    return {.velocity = held.velocity, .omega = held.omega};
  }
  const PileBody& on = members[isOfB ? manifold.a : manifold.b];
  const Vec3 armOn = isOfB ? point.world : Vec3(point.world + members.apart(manifold.a, manifold.b));
  // Velocities are those of the middle of the step: where what is on it is then.
  const Vec3 place = on.position + armOn + 0.5 * members.h * (on.velocity + on.omega.cross(armOn));
  const Vec3 along = (isOfB ? 1 : -1) * manifold.material.surface.along(n, place);
  const Vec3 turning = ((isOfB ? 1 : -1) * dot(n, manifold.material.surface.spin)) * n;
  const Vec3 arm = isOfB ? Vec3(point.world + members.apart(manifold.a, manifold.b)) : point.world;
  return {.velocity = along - turning.cross(arm), .omega = turning};
}

Vec3 velocityOfBelt(const CrowdMembers& members, const PileManifold& manifold, const ContactFrame& frame,
                    const PilePoint& point) {
  for (const bool isOfB : {false, true}) {
    const PileBody& body = members[isOfB ? manifold.b : manifold.a];
    if (body.isDriven()) {
      const Vec3 arm = isOfB ? Vec3(point.world + members.apart(manifold.a, manifold.b)) : point.world;
      return (isOfB ? 1 : -1) * (body.velocity + body.omega.cross(arm));
    }
  }
  return manifold.material.surface.along(frame.normal, members[manifold.a].position + point.world);
}

BeltBlock bodiesOnBelt(const CrowdMembers& members, const PileManifold& manifold, int belt) {
  return members[manifold.b].held() ? BeltBlock{.a = manifold.a, .b = belt}
                                    : BeltBlock{.a = belt, .b = manifold.b};
}

}  // namespace careen
