#include "physics/contact/implicit_step.h"

#include <algorithm>
#include <cmath>

#include "core/math/elementary.h"
#include "physics/contact/group_momentum.h"
#include "physics/contact/three_at.h"

// Motion in a step, and apart. Contacts are in implicit_step_contacts.cpp.

namespace careen {
namespace {

/// [1] of the tolerance in the time to fall, or to move, a half diagonal: a residual of the law that is as
/// good as none.
constexpr double kEnoughProgress = 0x1p-8;
/// [1] of that residual, where no better one was found however short the step: half the tolerance.
constexpr double kLastResort = 128;

Quat rotationBy(const Vec3& angle) {
  const double size = angle.norm();
  if (size == 0) {
    return Quat::Identity();
  }
  const auto half = elementary::sinCos(size / 2);
  const Vec3 axis = (half.sin / size) * angle;
  return {half.cos, axis[0], axis[1], axis[2]};
}

}  // namespace

double tolerableResidual(double tolerance, double radius, double rate, double gravity) {
  return kEnoughProgress * tolerance * std::max(rate, std::sqrt(gravity / radius));
}

ImplicitStep::ImplicitStep(const World& world, const std::vector<TouchingBody>& bodies, double tolerance)
    : world_(world), bodies_(bodies), tolerance_(tolerance), loads_(bodies.size()), turned_(bodies.size()) {
  for (const TouchingBody& body : bodies) {
    radius_ = body.isHeld() ? radius_ : std::max(radius_, radiusOf(*body.body));
  }
  if (!world.springs.empty() || world.drag) {
    for (const Body& body : world.bodies) {
      worldStates_.push_back(body.initial);
    }
  }
}

Vec3 ImplicitStep::spinOf(std::size_t body, const Mat3& turned, const Vec3& angularMomentum) const {
  return turned * bodies_[body].body->mass.inverseInertiaTimes(turned.transpose() * angularMomentum);
}

// Attitude of a body's principal axes.
Mat3 ImplicitStep::principalAt(std::size_t body, const GroupBody& at) const {
  return bodies_[body].body->mass.worldFromPrincipal(at.worldFromBody.toRotationMatrix());
}

Kinematics ImplicitStep::kinematics(std::size_t body, const GroupBody& at) const {
  Kinematics kinematics;
  kinematics.pose = {at.position, at.worldFromBody.toRotationMatrix()};
  if (!bodies_[body].isHeld()) {
    kinematics.velocity = at.velocity;
    kinematics.angularVelocity = spinOf(body, kinematics.pose.worldFromBody, at.angularMomentum);
  }
  return kinematics;
}

// How well the law is to be solved from that state.
void ImplicitStep::chooseResidual(const GroupState& at) {
  double rate = 0;  // [1/s]
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].isHeld()) {
      const Kinematics now = kinematics(i, at[i]);
      rate = std::max(rate, now.velocity.norm() / radius_ + now.angularVelocity.norm());
    }
  }
  residual_ = tolerableResidual(tolerance_, radius_, rate, pull(at));
}

// Force and torque on each body without contacts.
void ImplicitStep::findLoads(const GroupState& at) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    loads_[i] = {};
    if (!bodies_[i].isHeld()) {
      loads_[i].force = bodies_[i].body->mass.mass * world_.gravity;
    }
  }
  if (worldStates_.empty()) {
    return;
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].isHeld()) {
      worldStates_[static_cast<std::size_t>(bodies_[i].index)] = {
          .pose = {at[i].position, at[i].worldFromBody.toRotationMatrix()},
          .velocity = at[i].velocity,
          .angularMomentum = at[i].angularMomentum};
    }
  }
  computeLoads(world_, worldStates_, worldLoads_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].isHeld()) {
      loads_[i] = worldLoads_[static_cast<std::size_t>(bodies_[i].index)];
    }
  }
}

double ImplicitStep::freeAcceleration(const GroupState& state) {
  findLoads(state);
  double largest = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].isHeld()) {
      const MassProperties& mass = bodies_[i].body->mass;
      const double turning =
          loads_[i].torque.norm() * mass.inverseInertiaBody.maxCoeff() * radiusOf(*bodies_[i].body);
      largest = std::max(largest, mass.inverseMass * loads_[i].force.norm() + turning);
    }
  }
  return largest;
}

double ImplicitStep::pull(const GroupState& state) {
  const double gravity = world_.gravity.norm();
  return worldStates_.empty() ? gravity : std::max(gravity, freeAcceleration(state));
}

// Positions and attitudes at the end, from the velocities and angular momenta there.
void ImplicitStep::turn(const GroupState& from, double h, GroupState& to) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].isHeld()) {
      continue;
    }
    to[i].position = from[i].position + (0.5 * h) * (from[i].velocity + to[i].velocity);
    const Quat middle = Quat(from[i].worldFromBody.coeffs() + to[i].worldFromBody.coeffs()).normalized();
    const Vec3 spin =
        spinOf(i, middle.toRotationMatrix(), 0.5 * (from[i].angularMomentum + to[i].angularMomentum));
    to[i].worldFromBody = (rotationBy(h * spin) * from[i].worldFromBody).normalized();
  }
}

// Velocities and angular momenta at the end, given the contacts' impulses; then places.
void ImplicitStep::move(const GroupState& from, double h, GroupState& to) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].isHeld()) {
      to[i].velocity =
          from[i].velocity + bodies_[i].body->mass.inverseMass * (h * loads_[i].force + push_[i]);
      to[i].angularMomentum = from[i].angularMomentum + (h * loads_[i].torque + twist_[i]);
    }
  }
  turn(from, h, to);
}

void ImplicitStep::findMiddle(const GroupState& from, const GroupState& to) {
  middle_ = from;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].isHeld()) {
      middle_[i].position = 0.5 * (from[i].position + to[i].position);
      middle_[i].worldFromBody =
          Quat(from[i].worldFromBody.coeffs() + to[i].worldFromBody.coeffs()).normalized();
      middle_[i].velocity = 0.5 * (from[i].velocity + to[i].velocity);
      middle_[i].angularMomentum = 0.5 * (from[i].angularMomentum + to[i].angularMomentum);
    }
  }
}

bool ImplicitStep::advance(const GroupState& from, double h, std::vector<ClosedContact>& contacts,
                           GroupState& to, Order order) {
  chooseResidual(from);
  isLastResort_ = order == Order::kFirst;
  residual_ *= isLastResort_ ? kLastResort : 1;
  to = from;
  features_.clear();
  for (const ClosedContact& contact : contacts) {
    features_.push_back(contact.feature);
  }
  guessImpulses(from, h, contacts);
  findLoads(from);
  move(from, h, to);
  move(from, h, to);
  const bool depends = !worldStates_.empty();
  // Rows at the middle and law at the end depend on the step's own result: one pass alone is of first order.
  for (int pass = 0; pass < static_cast<int>(order) && (depends || !contacts.empty()); ++pass) {
    findMiddle(from, to);
    if (depends) {
      findLoads(middle_);
    }
    if (!contacts.empty() && !findImpulses(from, h, pass == 0, contacts, to)) {
      return false;
    }
    move(from, h, to);
  }
  if (depends) {  // the middle where springs pull is itself an estimate
    std::vector<ContactFeature> pushing;
    for (const ClosedContact& contact : contacts) {
      if (contact.push > 0) {
        pushing.push_back(contact.feature);
      }
    }
    keepMomenta(from, h, pushing, to);
  }
  return true;
}

bool ImplicitStep::compress(GroupState& state, std::span<const ContactFeature> contacts,
                            std::vector<ContactProblem::Triple>& impulses) {
  chooseResidual(state);
  placeBodies(contacts);
  for (const std::size_t i : movers_) {
    turned_[i] = principalAt(i, state[i]);
  }
  fillFree(state, 0);
  contactsAt(contacts, state, geometry_);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    addRows(contacts[c], geometry_[c]);
  }
  solution_.impulses.clear();
  if (!solve(residual_)) {
    return false;
  }
  addImpulses(contacts);
  impulses = solution_.impulses;
  for (const std::size_t i : movers_) {
    state[i].velocity += bodies_[i].body->mass.inverseMass * push_[i];
    state[i].angularMomentum += twist_[i];
  }
  return true;
}

void ImplicitStep::keepMomenta(const GroupState& before, double h, std::span<const ContactFeature> pushing,
                               GroupState& to) const {
  for (const std::vector<std::size_t>& group : freeGroups(world_, bodies_, pushing)) {
    const auto momentum = [&](const GroupState& at) {
      std::vector<GroupMember> members;
      for (const std::size_t i : group) {
        members.push_back({.mass = &bodies_[i].body->mass,
                           .state = {.pose = {at[i].position, at[i].worldFromBody.toRotationMatrix()},
                                     .velocity = at[i].velocity,
                                     .angularMomentum = at[i].angularMomentum}});
      }
      return momentumOf(members);
    };
    const std::optional<RigidChange> change = changeTo(momentum(before), h, world_.gravity, momentum(to));
    for (std::size_t k = 0; change && k < group.size(); ++k) {
      GroupBody& body = to[group[k]];
      body.velocity += change->velocityAt(body.position);
      body.position += change->shift;
      body.angularMomentum += careen::angularMomentum(bodies_[group[k]].body->mass,
                                                      body.worldFromBody.toRotationMatrix(), change->turning);
    }
  }
}

bool ImplicitStep::separate(GroupState& state, std::span<const ContactFeature> contacts, double deepest) {
  constexpr int kMostPasses = 4;
  const GroupState before = state;
  std::vector<ContactFeature> pushing;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    placeBodies(contacts);
    for (const std::size_t i : movers_) {
      turned_[i] = principalAt(i, state[i]);
    }
    bool deep = false;
    contactsAt(contacts, state, geometry_);
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      addRows(contacts[c], geometry_[c]);
      problem_.contacts.back().friction = 0;
      problem_.contacts.back().directions.clear();
      problem_.contacts.back().target[0] = -geometry_[c].gap;
      deep = deep || geometry_[c].gap < -deepest;
    }
    if (!deep) {
      break;
    }
    solution_.impulses.clear();
    if (!solve(kEnoughProgress * tolerance_)) {
      return false;
    }
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      if (solution_.impulses[c][0] > 0) {
        pushing.push_back(contacts[c]);
      }
    }
    for (std::size_t m = 0; m < movers_.size(); ++m) {
      GroupBody& body = state[movers_[m]];
      body.position += threeAt(solution_.velocities, m * kSix);
      const Vec3 turn =
          bodies_[movers_[m]].body->mass.fromPrincipal(threeAt(solution_.velocities, m * kSix + 3));
      body.worldFromBody = (body.worldFromBody * rotationBy(turn)).normalized();
    }
  }
  if (!pushing.empty()) {
    keepMomenta(before, 0, pushing, state);
  }
  return true;
}

}  // namespace careen
