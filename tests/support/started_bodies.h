#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "physics/exact/aftermath.h"
#include "physics/exact/bodies.h"
#include "physics/exact/crowd_group.h"
#include "physics/exact/encounter.h"
#include "physics/exact/encounter_contacts.h"
#include "physics/exact/encounter_impact.h"
#include "support/exact_runs.h"
#include "support/physics_worlds.h"

namespace careen::test {

/// The bodies of a world at the start of a run of 100 s: each flies or, if it is held, rests.
struct StartedBodies {
  explicit StartedBodies(World given, CrowdSettings crowds = {})
      : world(std::move(given)), bodies(world, {.duration = 100, .crowds = crowds}, memory) {
    for (int rank = 0; rank < bodies.count(); ++rank) {
      const BodyState& initial = bodies[rank].body->initial;
      if (bodies[rank].isHeld()) {
        bodies.rest(rank, {}, initial.pose);
      } else {
        bodies.fly(rank, {}, initial, Quat(initial.pose.worldFromBody));
      }
    }
    bodies.account().parted();
  }
  StartedBodies(const StartedBodies&) = delete;
  StartedBodies& operator=(const StartedBodies&) = delete;

  /// What follows for those that touch that body now.
  Encounter encounter(int rank, double time = 0) {
    Encounter found = gather(bodies, {.time = Instant(time), .kind = EventKind::kContact, .body = rank});
    findContacts(bodies, found);
    return found;
  }
  Encounter settled(int rank, double time = 0) {
    Encounter found = encounter(rank, time);
    resolve(bodies, found);
    settle(bodies, found);
    return found;
  }

  World world;
  Memory memory;
  Bodies bodies;
};

/// The crowd of those that touch that body now.
inline std::shared_ptr<CrowdGroup> crowdOf(StartedBodies& all, int rank) {
  CrowdGroup::form(all.bodies, all.encounter(rank));
  return std::static_pointer_cast<CrowdGroup>(all.bodies[rank].group);
}

/// A cube of 1 kg whose edges are 1 m.
inline Body cube(const std::string& name, const Vec3& position, const Vec3& velocity = Vec3::Zero(),
                 Material material = {}) {
  Body body = box(name, Vec3::Constant(0.5), 1, position, velocity);
  body.material = material;
  return body;
}
inline Body held(Body body) {
  body.mass = immovable();
  return body;
}
/// Gravity of 10 m/s² down; e = 0.
inline World onFloor(std::vector<Body> bodies, double friction = 0) {
  World world;
  world.gravity = Vec3(0, 0, -10);
  world.walls = {{.name = "floor", .normal = Vec3::UnitZ(), .offset = 0, .material = {.friction = friction}}};
  world.bodies = std::move(bodies);
  return world;
}
inline World afloat(std::vector<Body> bodies) {
  World world;
  world.bodies = std::move(bodies);
  return world;
}

}  // namespace careen::test
