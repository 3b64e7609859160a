#pragma once

#include <cstddef>
#include <memory>

#include "physics/pile/crowd_apart.h"
#include "physics/pile/crowd_articulations.h"
#include "physics/pile/crowd_bounce.h"
#include "physics/pile/crowd_contacts.h"
#include "physics/pile/crowd_depth.h"
#include "physics/pile/crowd_impulses.h"
#include "physics/pile/crowd_loads.h"
#include "physics/pile/crowd_members.h"
#include "physics/pile/crowd_memory.h"
#include "physics/pile/crowd_motion.h"
#include "physics/pile/crowd_path.h"
#include "physics/pile/crowd_seams.h"
#include "physics/pile/crowd_sleep.h"

namespace careen::test {

/// [s] The longest step at the usual tolerance.
inline constexpr double kCrowdStep = 1.0 / 180;

/// The stages of a crowd's step, to be taken one by one: all bodies of a world, in its order.
struct CrowdStages {
  explicit CrowdStages(const World& world)
      : members(world, CrowdMembers::kUsualTolerance, std::make_shared<Team>(1)),
        loads(members, memory),
        contacts(members),
        articulations(members),
        impulses(members, loads, contacts, articulations, memory),
        bounces(members, loads, contacts, articulations, memory),
        depth(members, contacts),
        apart(members, contacts, articulations, depth, memory),
        sleep(members, loads, contacts, articulations, memory),
        path(members, loads, contacts),
        seams(members, contacts, memory) {
    memory.length = members.h;
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      members.add(pileBody(world.bodies[i], world.bodies[i].initial), i);
      memory.places.resize(members.size());
      loads.limitBySprings(i);
    }
  }

  /// The place of a body of the world: walls come first.
  std::size_t of(int body) const { return members.world.walls.size() + at(body); }
  /// The contacts of a step of that length [s].
  void meet(double h) {
    members.h = members.span = memory.length = h;
    contacts.begin();
    contacts.lookAtAll();
    contacts.listNear();
  }
  /// That step, up to its end.
  void take(double h) {
    members.begin();
    meet(h);
    impulses.find();
    impulses.keep();
    bounces.find();
    moveMembers(members, loads, impulses);
    bounces.bounce(impulses);
  }
  PileManifold& manifold(std::size_t n = 0) { return contacts[contacts.near()[n]]; }

  CrowdMembers members;
  CrowdMemory memory;
  CrowdLoads loads;
  CrowdContacts contacts;
  CrowdArticulations articulations;
  CrowdImpulses impulses;
  CrowdBounces bounces;
  CrowdDepth depth;
  CrowdApart apart;
  CrowdSleep sleep;
  CrowdPath path;
  CrowdSeams seams;
};

}  // namespace careen::test
