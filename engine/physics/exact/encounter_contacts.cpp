#include "physics/exact/encounter_contacts.h"

#include <algorithm>

#include "physics/contact/found_contacts.h"
#include "physics/contact/implicit_step.h"
#include "physics/contact/island.h"
#include "physics/geometry/chosen_contact.h"
#include "physics/impact/wall_contacts.h"

namespace careen {
namespace {

bool isInSteps(const EncounterBody& a, const EncounterBody& b) {
  return a.mover->steps() || b.mover->steps();
}

// [m] How well the places of two bodies that meet are known: in steps only to the tolerance.
double knownTo(double tolerance, const EncounterBody& a, const EncounterBody& b) {
  return std::max(isInSteps(a, b) ? 0.25 * tolerance : 0, touchingWithin(a.box(), b.box()));
}

// [m/s] Likewise of their velocities; `pull` [m/s²] of the encounter.
double slowOf(double tolerance, double pull, const EncounterBody& a, const EncounterBody& b) {
  double speeds = 0;
  double radius = 0;
  for (const EncounterBody* each : {&a, &b}) {
    const Body& body = each->body();
    speeds += each->before.velocity.norm() + angularVelocity(body.mass, each->before).norm() * radiusOf(body);
    radius = std::max(radius, radiusOf(body));
  }
  const double found = isInSteps(a, b) ? tolerableResidual(tolerance, radius, speeds / radius, pull) : 0;
  return std::max(kApproachRounding * speeds, found);
}

// Adds the contacts of two boxes that touch.
void addBoxContacts(double tolerance, Encounter& encounter, std::size_t indexA, const BoxAt& boxA,
                    std::size_t indexB, const BoxAt& boxB) {
  const EncounterBody& a = encounter.bodies[indexA];
  const EncounterBody& b = encounter.bodies[indexB];
  const auto velocityOf = [](const EncounterBody& body, const Vec3& arm) {
    return Vec3(body.before.velocity + angularVelocity(body.body().mass, body.before).cross(arm));
  };
  const ChosenContact contact = chosenContact(
      boxA, boxB, 0, knownTo(tolerance, a, b), slowOf(tolerance, encounter.pull, a, b),
      [&](const Vec3& armA, const Vec3& armB) { return Vec3(velocityOf(a, armA) - velocityOf(b, armB)); });
  for (const ContactPoint& at : contact.points) {
    encounter.contacts.push_back({.a = static_cast<int>(indexA),
                                  .b = static_cast<int>(indexB),
                                  .armA = at.armA,
                                  .armB = at.armB,
                                  .normal = at.normal,
                                  .material = touching(a.body().material, b.body().material),
                                  .boxA = boxA.part,
                                  .boxB = boxB.part,
                                  .inCone = at.inCone,
                                  .axes = contact.choice,
                                  .directions = directionsOf(contact.choice, boxA, boxB)});
  }
}

// Adds the contacts of two bodies that touch.
void addPairContacts(const World& world, double tolerance, Encounter& encounter, std::size_t indexA,
                     std::size_t indexB) {
  const EncounterBody& a = encounter.bodies[indexA];
  const EncounterBody& b = encounter.bodies[indexB];
  if ((a.mover->isHeld() && b.mover->isHeld()) || !mayTouch(world, a.listed(), b.listed())) {
    return;
  }
  forBoxes(a.body(), a.before.pose, b.body(), b.before.pose, [&](const BoxAt& boxA, const BoxAt& boxB) {
    if (areTouching(boxA, boxB)) {
      addBoxContacts(tolerance, encounter, indexA, boxA, indexB, boxB);
    }
  });
}

}  // namespace

std::vector<ImpactContact> closedJoints(const Encounter& encounter) {
  std::vector<ImpactContact> closed;
  for (std::size_t k = 0; k < encounter.joints.size(); ++k) {
    const ContactFeature& joint = encounter.joints[k];
    const EncounterBody& first = encounter.bodies[static_cast<std::size_t>(joint.a)];
    const TouchingBody a = first.touching(encounter.time);
    const TouchingBody b = encounter.bodies[static_cast<std::size_t>(joint.b)].touching(encounter.time);
    const ContactState state =
        contactState(joint, a.kinematics(), a.shape(joint.boxA), b.kinematics(), b.shape(joint.boxB));
    if (joint.grips()) {
      continue;  // no impulse in no time
    }
    if (joint.holds() || state.gap <= Island::kTouching * touchingWithin(first.box())) {
      closed.push_back(impactContactOf(joint, state, static_cast<int>(k)));
    }
  }
  return closed;
}

double findContacts(const Bodies& bodies, Encounter& encounter) {
  double deepest = 0;
  const std::size_t boxes = encounter.boxes().size();
  for (std::size_t i = 0; i < boxes; ++i) {
    const EncounterBody& body = encounter.bodies[i];
    if (!body.mover->isHeld()) {
      deepest = std::max(deepest,
                         addWallContacts(bodies.world(), body.body(), body.before.pose, static_cast<int>(i),
                                         static_cast<int>(boxes), encounter.contacts, encounter.time.hi));
    }
    for (std::size_t j = i + 1; j < boxes; ++j) {
      addPairContacts(bodies.world(), bodies.tolerance(), encounter, i, j);
    }
  }
  const std::vector<ImpactContact> joints = closedJoints(encounter);
  encounter.contacts.insert(encounter.contacts.end(), joints.begin(), joints.end());
  encounter.shares.resize(encounter.contacts.size());
  encounter.persists.assign(encounter.contacts.size(), 0);
  return deepest;
}

void choose(const Bodies& bodies, Encounter& encounter, std::size_t k, const Vec3& velocity) {
  ImpactContact& contact = encounter.contacts[k];
  if (contact.axes == 0) {
    return;
  }
  const EncounterBody& a = encounter.a(k);
  const EncounterBody& b = encounter.b(k);
  const BoxAt boxA = a.box(contact.boxA);
  const BoxAt boxB = b.box(contact.boxB);
  const AxisSet open =
      withoutApproached(contact.axes, boxA, boxB, velocity, slowOf(bodies.tolerance(), encounter.pull, a, b));
  if (open == contact.axes) {
    return;
  }
  constexpr double kSame = 1 - 0x1p-40;
  if (contact.inCone || dot(directionsOf(open, boxA, boxB).front(), contact.normal) < kSame) {
    encounter.persists[k] = 0;
  }
  contact.axes = 0;
  contact.directions.clear();
}

}  // namespace careen
