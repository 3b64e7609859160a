#include <algorithm>

#include "physics/contact/implicit_step.h"
#include "physics/exact/exact_world.h"
#include "physics/geometry/chosen_contact.h"

// Contacts of two bodies that meet: where, and along which of their axes they are kept apart.

namespace careen {

// Adds the contacts of two bodies that touch.
void ExactWorld::addPairContacts(Encounter& encounter, std::size_t indexA, std::size_t indexB) const {
  const Body& a = *mover(encounter.ranks[indexA]).body;
  const Body& b = *mover(encounter.ranks[indexB]).body;
  const BoxAt boxA = boxOf(encounter, indexA);
  const BoxAt boxB = boxOf(encounter, indexB);
  if ((isImmovable(a.mass) && isImmovable(b.mass)) || !areTouching(boxA, boxB)) {
    return;
  }
  const auto velocityOf = [&](std::size_t index, const Vec3& arm) {
    const BodyState& state = encounter.before[index];
    const MassProperties& mass = mover(encounter.ranks[index]).body->mass;
    return Vec3(state.velocity + careen::angularVelocity(mass, state).cross(arm));
  };
  const ChosenContact contact =
      chosenContact(boxA, boxB, 0, knownTo(encounter, indexA, indexB), slowOf(encounter, indexA, indexB),
                    [&](const Vec3& armA, const Vec3& armB) {
                      return Vec3(velocityOf(indexA, armA) - velocityOf(indexB, armB));
                    });
  for (const ContactPoint& at : contact.points) {
    encounter.contacts.push_back({.a = static_cast<int>(indexA),
                                  .b = Partner::ofBody(static_cast<int>(indexB)),
                                  .armA = at.armA,
                                  .armB = at.armB,
                                  .normal = at.normal,
                                  .material = touching(a.material, b.material),
                                  .inCone = at.inCone,
                                  .axes = contact.choice,
                                  .directions = directionsOf(contact.choice, boxA, boxB)});
  }
}

bool ExactWorld::inSteps(const Encounter& encounter, std::size_t indexA, std::size_t indexB) const {
  return mover(encounter.ranks[indexA]).touches() || mover(encounter.ranks[indexB]).touches();
}

// [m] How well the places of two bodies that meet are known: in steps only to the tolerance.
double ExactWorld::knownTo(const Encounter& encounter, std::size_t indexA, std::size_t indexB) const {
  return std::max(inSteps(encounter, indexA, indexB) ? 0.25 * tolerance_ : 0,
                  touchingWithin(boxOf(encounter, indexA), boxOf(encounter, indexB)));
}

// [m/s] Likewise of their velocities.
double ExactWorld::slowOf(const Encounter& encounter, std::size_t indexA, std::size_t indexB) const {
  double speeds = 0;
  double radius = 0;
  for (const std::size_t index : {indexA, indexB}) {
    const Body& body = *mover(encounter.ranks[index]).body;
    const BodyState& state = encounter.before[index];
    speeds += state.velocity.norm() + careen::angularVelocity(body.mass, state).norm() * radiusOf(body);
    radius = std::max(radius, radiusOf(body));
  }
  const double found = inSteps(encounter, indexA, indexB)
                           ? tolerableResidual(tolerance_, radius, speeds / radius, encounter.pull)
                           : 0;
  return std::max(kApproachRounding * speeds, found);
}

// Of a contact's axes, those that its bodies approach keep nothing apart from now on. If one direction is
// left, the contact is one along it; if it was another one, it is met anew.
void ExactWorld::choose(Encounter& encounter, std::size_t k, const Vec3& velocity) const {
  ImpactContact& contact = encounter.contacts[k];
  if (contact.axes == 0) {
    return;
  }
  const auto a = static_cast<std::size_t>(contact.a);
  const auto b = static_cast<std::size_t>(contact.b.body());
  const BoxAt boxA = boxOf(encounter, a);
  const BoxAt boxB = boxOf(encounter, b);
  const AxisSet open = withoutApproached(contact.axes, boxA, boxB, velocity, slowOf(encounter, a, b));
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
