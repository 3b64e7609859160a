#include "physics/exact/encounter_impact.h"

#include <algorithm>
#include <vector>

#include "physics/contact/implicit_step.h"
#include "physics/contact/joint_rows.h"

namespace careen {

void resolve(Bodies& bodies, Encounter& encounter) {
  std::vector<ImpactBody> struck;
  struck.reserve(encounter.bodies.size());
  bool mayLose = false;
  double radius = 0;
  double rate = 0;  // [1/s]
  for (EncounterBody& each : encounter.bodies) {
    const MassProperties& mass = each.body().mass;
    struck.push_back({.mass = &mass, .state = &each.after});
    mayLose = mayLose || each.mover->steps();
    if (each.mover->flies()) {
      bodies.arrive(*each.mover, encounter.time, each.before);
    }
    if (!isImmovable(mass)) {
      const double size = radiusOf(each.body());
      radius = std::max(radius, size);
      rate = std::max(rate, each.before.velocity.norm() / size + angularVelocity(mass, each.before).norm());
    }
  }
  std::vector<ImpactContact> contacts;
  for (std::size_t k = 0; k < encounter.contacts.size(); ++k) {
    contacts.push_back(encounter.joined(k));
    mayLose = mayLose || contacts[k].material.restitution < 1 || contacts[k].material.friction > 0;
  }
  if (mayLose) {
    bodies.account().mayLose();
  }
  bodies.account().solved(
      resolveImpact(struck, contacts, encounter.shares,
                    {.tolerable = tolerableResidual(bodies.tolerance(), radius, rate, encounter.pull)}));
}

void record(Bodies& bodies, const Encounter& encounter) {
  std::vector<DoubtfulBody> doubtful;
  for (const EncounterBody& each : encounter.bodies) {
    doubtful.push_back(careen::doubtful(bodies, each.mover->rank, encounter.time, each.after));
  }
  for (std::size_t k = 0; k < encounter.contacts.size(); ++k) {
    if (encounter.shares[k].impulse > 0 && encounter.contacts[k].joint != ImpactContact::kNoJoint) {
      bodies.recorder().passes(
          jointImpulseOf(bodies.world(), encounter.time.hi,
                         encounter.joints[static_cast<std::size_t>(encounter.contacts[k].joint)],
                         encounter.contacts[k], encounter.shares[k], encounter.a(k).before.pose.position));
    } else if (encounter.shares[k].impulse > 0) {
      const ImpactContact contact = encounter.joined(k);
      touch(doubtful, contact, encounter.shares[k]);
      bodies.strike(encounter.time, encounter.a(k).mover->rank, encounter.b(k).mover->rank,
                    encounter.a(k).before.pose.position + contact.armA, encounter.shares[k]);
    }
  }
  doubtMore(doubtful);
}

}  // namespace careen
