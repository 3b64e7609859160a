#pragma once

#include "physics/geometry/contact_points.h"
#include "physics/geometry/separating_axes.h"

namespace careen {

/// The contact of two boxes that move.
struct ChosenContact {
  ContactPoints points;
  AxisSet choice = 0;  ///< several axes one of which keeps them apart; none if the points' normal does
};

/// Of two boxes whose places are known to `within` [m], points with a gap up to `apart` [m]. Along axes that
/// are approached faster than `slow` [m/s] they are not kept apart: if that leaves one direction, it is the
/// normal, should the contact have to take part. `velocityAt(armA, armB)` [m/s]: of a relative to b.
template <class VelocityAt>
ChosenContact chosenContact(const BoxAt& a, const BoxAt& b, double apart, double within, double slow,
                            const VelocityAt& velocityAt) {
  ChosenContact contact{.points = boxContactPoints(a, b, apart), .choice = separatingAxes(a, b, within)};
  if (contact.choice == 0 || contact.points.size() == 0) {
    return contact;
  }
  Vec3 armA = Vec3::Zero();
  Vec3 armB = Vec3::Zero();
  const double share = 1 / static_cast<double>(contact.points.size());
  for (const ContactPoint& point : contact.points) {
    armA += share * point.armA;
    armB += share * point.armB;
  }
  const AxisSet open = withoutApproached(contact.choice, a, b, velocityAt(armA, armB), slow);
  if (open != contact.choice) {
    contact.points = boxContactPoints(a, b, apart, open);
  }
  return contact;
}

}  // namespace careen
