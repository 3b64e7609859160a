#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "core/math/order_free_sum.h"
#include "physics/contact/implicit_step.h"
#include "physics/contact/three_at.h"
#include "physics/geometry/contact_frame.h"
#include "physics/solver/contact_rows.h"

// Contacts of a step: where they are, their equations, the impulses that solve them.

namespace careen {
namespace {

// [N s] What a contact's last forces give in `h` [s]: along the normal and the tangents.
ContactProblem::Triple impulseOf(const ClosedContact& contact, const Vec3& normal, double h) {
  const ContactFrame frame = frameOf(normal);
  return {h * contact.push, h * dot(contact.friction, frame.tangent1),
          h * dot(contact.friction, frame.tangent2)};
}

}  // namespace

ContactState ImplicitStep::stateOf(const ContactFeature& feature, const Kinematics& a,
                                   const Kinematics* b) const {
  const BoxShape boxA = shapeOf(*bodies_[static_cast<std::size_t>(feature.a)].body);
  if (b == nullptr) {
    return contactState(feature, a, boxA, nullptr, boxA, &world_.walls[feature.b.wall()]);
  }
  const BoxShape boxB = shapeOf(*bodies_[static_cast<std::size_t>(feature.b.body())].body);
  ContactState at = contactState(feature, a, boxA, b, boxB, nullptr);
  // One point for both, else the pair's impulses would change angular momentum by gap × friction.
  const Vec3 link = (a.pose.position - b->pose.position) + (at.armA - at.armB);
  at.armA -= 0.5 * link;
  at.armB += 0.5 * link;
  return at;
}

ContactState ImplicitStep::contactAt(const ContactFeature& feature, const GroupState& state) const {
  const auto a = static_cast<std::size_t>(feature.a);
  const Kinematics ofA = kinematics(a, state[a]);
  if (feature.b.isWall()) {
    return stateOf(feature, ofA, nullptr);
  }
  const auto b = static_cast<std::size_t>(feature.b.body());
  const Kinematics ofB = kinematics(b, state[b]);
  return stateOf(feature, ofA, &ofB);
}

void ImplicitStep::contactsAt(std::span<const ContactFeature> features, const GroupState& state,
                              std::vector<ContactState>& contacts) {
  kinematics_.clear();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    kinematics_.push_back(kinematics(i, state[i]));
  }
  contacts.clear();
  for (const ContactFeature& feature : features) {
    const Kinematics& ofA = kinematics_[static_cast<std::size_t>(feature.a)];
    if (feature.b.isWall()) {
      contacts.push_back(stateOf(feature, ofA, nullptr));
      continue;
    }
    contacts.push_back(stateOf(feature, ofA, &kinematics_[static_cast<std::size_t>(feature.b.body())]));
  }
  normals_.align(features, {}, contacts);
}

// Only bodies with contacts are part of the problem.
void ImplicitStep::placeBodies(std::span<const ContactFeature> contacts) {
  places_.assign(bodies_.size(), ContactProblem::kNobody);
  movers_.clear();
  problem_.inverseMass.clear();
  problem_.contacts.clear();
  std::vector<char> touched(bodies_.size(), 0);
  for (const ContactFeature& feature : contacts) {
    touched[static_cast<std::size_t>(feature.a)] = 1;
    if (!feature.b.isWall()) {
      touched[static_cast<std::size_t>(feature.b.body())] = 1;
    }
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (touched[i] != 0 && !bodies_[i].isHeld()) {
      places_[i] = static_cast<int>(movers_.size());
      movers_.push_back(i);
      const MassProperties& mass = bodies_[i].body->mass;
      problem_.inverseMass.insert(problem_.inverseMass.end(), 3, mass.inverseMass);
      for (int k = 0; k < 3; ++k) {
        problem_.inverseMass.push_back(mass.inverseInertiaBody[k]);
      }
    }
  }
  problem_.free.assign(problem_.inverseMass.size(), 0.0);
}

// Rows of a contact: arms and normal of `geometry`, angular velocities in the frames `turned_`.
void ImplicitStep::addRows(const ContactFeature& feature, const ContactState& geometry) {
  ContactProblem::Contact contact;
  const ContactFrame frame = frameOf(geometry.normal);
  const auto addSide = [&](std::size_t body, std::size_t side, const Vec3& arm, double sign) {
    if (places_[body] != ContactProblem::kNobody) {
      setSide(contact, side, pointSide(frame.axes(), arm, sign), turned_[body]);
    }
    return places_[body];
  };
  contact.a = addSide(static_cast<std::size_t>(feature.a), 0, geometry.armA, 1);
  if (!feature.b.isWall()) {
    contact.b = addSide(static_cast<std::size_t>(feature.b.body()), 1, geometry.armB, -1);
  }
  contact.friction = feature.material.friction;
  for (const Vec3& direction : geometry.directions) {
    contact.directions.push_back(frame.along(direction));
  }
  problem_.contacts.push_back(contact);
}

bool ImplicitStep::solve(double enough) {
  solution_.enough = enough;
  const bool solved = solver_.solve(problem_, solution_);
  work_ += solution_.factorisations * static_cast<double>(movers_.size() + problem_.contacts.size());
  if (work_ > mostWork_) {
    throw NumericalError("a step of " + std::to_string(movers_.size()) + " bodies in contact costs too much");
  }
  return solved;
}

// Velocities of the problem's bodies without contacts, `h` [s] after a state.
void ImplicitStep::fillFree(const GroupState& from, double h) {
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    const std::size_t i = movers_[m];
    const MassProperties& mass = bodies_[i].body->mass;
    setThree(problem_.free, m * kSix, from[i].velocity + (h * mass.inverseMass) * loads_[i].force);
    const Vec3 angular = from[i].angularMomentum + h * loads_[i].torque;
    setThree(problem_.free, m * kSix + 3,
             mass.inverseInertiaBody.cwiseProduct(turned_[i].transpose() * angular));
  }
}

// The law holds for the velocities at the end of the step, where arms and normal are others than in the rows.
void ImplicitStep::aimAtEnd(std::size_t index, const ContactFeature& feature, const GroupState& to) {
  ContactProblem::Contact& contact = problem_.contacts[index];
  const ContactFrame frame = frameOf(geometry_[index].normal);
  const ContactState& end = ends_[index];
  const std::array<double, 3> actual{end.rate, dot(end.slip, frame.tangent1), dot(end.slip, frame.tangent2)};
  for (std::size_t row = 0; row < 3; ++row) {
    double speed = 0;
    const std::array<int, 2> sides{contact.a, contact.b};
    const std::array<int, 2> bodies{feature.a, feature.b.isWall() ? 0 : feature.b.body()};
    for (std::size_t side = 0; side < 2; ++side) {
      if (sides[side] == ContactProblem::kNobody) {
        continue;
      }
      const auto i = static_cast<std::size_t>(bodies[side]);
      const Vec3 spin = bodies_[i].body->mass.inverseInertiaBody.cwiseProduct(turned_[i].transpose() *
                                                                              to[i].angularMomentum);
      const double* values = &contact.rows[row][side * kSix];
      speed += dot(Vec3(values[0], values[1], values[2]), to[i].velocity) +
               dot(Vec3(values[3], values[4], values[5]), spin);
    }
    contact.target[row] = speed - actual[row];
  }
}

// Sums over contacts do not depend on their order, which names and mirroring change.
void ImplicitStep::addImpulses(std::span<const ContactFeature> features) {
  parts_.resize(bodies_.size());
  for (std::vector<Six>& parts : parts_) {
    parts.clear();
  }
  for (std::size_t c = 0; c < features.size(); ++c) {
    const Vec3 push = frameOf(geometry_[c].normal).inWorld(solution_.impulses[c]);
    const auto add = [&](int body, const Vec3& arm, double sign) {
      const Vec3 twist = sign * arm.cross(push);
      parts_[static_cast<std::size_t>(body)].push_back(
          {sign * push[0], sign * push[1], sign * push[2], twist[0], twist[1], twist[2]});
    };
    add(features[c].a, geometry_[c].armA, 1);
    if (!features[c].b.isWall()) {
      add(features[c].b.body(), geometry_[c].armB, -1);
    }
  }
  push_.resize(bodies_.size());
  twist_.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Six sum = orderFreeSums<kSix>(parts_[i]);
    push_[i] = {sum[0], sum[1], sum[2]};
    twist_[i] = {sum[3], sum[4], sum[5]};
  }
}

// The first estimate of a step's impulses: by the last forces. Without them bodies at rest would fall, and
// springs and drag be those of a motion that never was.
void ImplicitStep::guessImpulses(const GroupState& from, double h,
                                 const std::vector<ClosedContact>& contacts) {
  contactsAt(features_, from, geometry_);
  solution_.impulses.clear();
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    solution_.impulses.push_back(impulseOf(contacts[c], geometry_[c].normal, h));
  }
  addImpulses(features_);
}

// The points at which the impulses act are those of the last estimate of the middle; the centres of mass are
// by now known to be elsewhere there. About them angular momentum is exchanged exactly.
void ImplicitStep::moveArms(const GroupState& from, double h) {
  for (const std::size_t i : movers_) {
    const Vec3 gained = bodies_[i].body->mass.inverseMass * (h * loads_[i].force + push_[i]);
    const Vec3 middle = from[i].position + (0.5 * h) * (from[i].velocity + 0.5 * gained);
    twist_[i] += (middle_[i].position - middle).cross(push_[i]);
  }
}

// The step's impulses, with rows at its middle; `to` is the last estimate of its end.
bool ImplicitStep::findImpulses(const GroupState& from, double h, bool first,
                                std::vector<ClosedContact>& contacts, const GroupState& to) {
  placeBodies(features_);
  for (const std::size_t i : movers_) {
    turned_[i] = principalAt(i, to[i]);
  }
  fillFree(from, h);
  contactsAt(features_, middle_, geometry_);
  if (!first) {
    contactsAt(features_, to, ends_);
  }
  solution_.impulses.clear();
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    addRows(features_[c], geometry_[c]);
    if (!first) {
      aimAtEnd(c, features_[c], to);
    }
    solution_.impulses.push_back(impulseOf(contacts[c], geometry_[c].normal, h));
  }
  if (!solve(residual_) && !(isLastResort_ && solution_.residual <= residual_)) {
    return false;
  }
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const ContactProblem::Triple& impulse = solution_.impulses[c];
    contacts[c].push = impulse[0] / h;
    contacts[c].friction = frameOf(geometry_[c].normal).across(impulse[1], impulse[2]) / h;
  }
  addImpulses(features_);
  moveArms(from, h);
  return true;
}

}  // namespace careen
