#include "study/world_description.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace careen {
namespace {

using Json = nlohmann::ordered_json;

Json listOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Json listOf(const Mat3& rotation) {
  const Quat q = Quat(rotation).normalized();
  return {q.w(), q.x(), q.y(), q.z()};
}

Json boxOf(const Body& body) {
  Json box = {{"name", body.name},
              {"half_extents", listOf(body.halfExtents)},
              {"middle", listOf(body.boxCenter)},
              {"restitution", body.material.restitution},
              {"friction", body.material.friction},
              {"position", listOf(body.initial.pose.position)},
              {"orientation", listOf(body.initial.pose.worldFromBody)}};
  for (const BodyPart& part : body.parts) {
    box["parts"].push_back({{"half_extents", listOf(part.halfExtents)},
                            {"middle", listOf(part.middle())},
                            {"orientation", listOf(part.bodyFromPart)}});
  }
  box["fixed"] = isImmovable(body.mass);
  if (!isImmovable(body.mass)) {
    box["mass"] = body.mass.mass;
    box["moments"] = listOf(body.mass.inertiaBody);
    box["axes"] = listOf(body.mass.bodyFromPrincipal);
    box["velocity"] = listOf(body.initial.velocity);
    box["angular_velocity"] = listOf(angularVelocity(body.mass, body.initial));
  }
  return box;
}

}  // namespace

Json descriptionOf(const World& world) {
  Json walls = Json::array();
  for (const Wall& wall : world.walls) {
    walls.push_back({{"normal", listOf(wall.normal)},
                     {"offset", wall.offset},
                     {"restitution", wall.material.restitution},
                     {"friction", wall.material.friction}});
  }
  Json boxes = Json::array();
  for (const Body& body : world.bodies) {
    boxes.push_back(boxOf(body));
  }
  return {{"gravity", listOf(world.gravity)}, {"walls", walls}, {"boxes", boxes}};
}

}  // namespace careen
