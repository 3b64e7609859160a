#include "physics/contact/implicit_step.h"

#include <algorithm>
#include <cmath>

#include "core/math/elementary.h"
#include "physics/geometry/contact_frame.h"

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

Quat middleOf(const Quat& from, const Quat& to) { return Quat(from.coeffs() + to.coeffs()).normalized(); }

// [N s] What a contact's last forces give in `h` [s]: along the normal and the tangents, or its rows.
ContactProblem::Triple impulseOf(const ClosedContact& contact, const Vec3& normal, double h) {
  if (contact.feature.isTwoSided()) {
    return {h * contact.friction[0], h * contact.friction[1], h * contact.friction[2]};
  }
  const ContactFrame frame = frameOf(normal);
  return {h * contact.push, h * dot(contact.friction, frame.tangent1),
          h * dot(contact.friction, frame.tangent2)};
}

}  // namespace

std::vector<ContactFeature> pushing(std::span<const ClosedContact> contacts) {
  std::vector<ContactFeature> features;
  for (const ClosedContact& contact : contacts) {
    if (contact.push > 0) {
      features.push_back(contact.feature);
    }
  }
  return features;
}

double tolerableResidual(double tolerance, double radius, double rate, double gravity) {
  return kEnoughProgress * tolerance * std::max(rate, std::sqrt(gravity / radius));
}

ImplicitStep::ImplicitStep(const World& world, const std::vector<TouchingBody>& bodies, double tolerance)
    : group_(world, bodies), loads_(group_), impulses_(group_), tolerance_(tolerance) {
  for (const TouchingBody& body : bodies) {
    radius_ = body.isHeld() ? radius_ : std::max(radius_, radiusOf(*body.body));
  }
}

// How well the law is to be solved from that state.
void ImplicitStep::chooseResidual(const GroupState& at) {
  double rate = 0;  // [1/s]
  for (std::size_t i = 0; i < group_.size(); ++i) {
    if (!group_.isHeld(i)) {
      const Kinematics now = group_.kinematics(i, at[i]);
      rate = std::max(rate, now.velocity.norm() / radius_ + now.angularVelocity.norm());
    }
  }
  residual_ = tolerableResidual(tolerance_, radius_, rate, loads_.pull(at));
}

// Positions and attitudes at the end, from the velocities and angular momenta there.
void ImplicitStep::turn(const GroupState& from, double h, GroupState& to) const {
  group_.drive(from, h, to);
  for (std::size_t i = 0; i < group_.size(); ++i) {
    if (group_.isHeld(i)) {
      continue;
    }
    to[i].position = from[i].position + (0.5 * h) * (from[i].velocity + to[i].velocity);
    const Vec3 spin =
        group_.angularVelocity(i, middleOf(from[i].worldFromBody, to[i].worldFromBody).toRotationMatrix(),
                               0.5 * (from[i].angularMomentum + to[i].angularMomentum));
    to[i].worldFromBody = (rotationBy(h * spin) * from[i].worldFromBody).normalized();
    to[i].time = from[i].time + h;
  }
}

// Velocities and angular momenta at the end, given the contacts' impulses; then places.
void ImplicitStep::move(const GroupState& from, double h, GroupState& to) const {
  for (std::size_t i = 0; i < group_.size(); ++i) {
    if (!group_.isHeld(i)) {
      to[i].velocity =
          from[i].velocity + group_.body(i).mass.inverseMass * (h * loads_[i].force + gained_[i].push);
      to[i].angularMomentum = from[i].angularMomentum + (h * loads_[i].torque + gained_[i].twist);
    }
  }
  turn(from, h, to);
}

void ImplicitStep::findMiddle(const GroupState& from, double h, const GroupState& to) {
  middle_ = from;
  group_.drive(from, 0.5 * h, middle_);
  for (std::size_t i = 0; i < group_.size(); ++i) {
    if (!group_.isHeld(i)) {
      middle_[i] = {.position = 0.5 * (from[i].position + to[i].position),
                    .worldFromBody = middleOf(from[i].worldFromBody, to[i].worldFromBody),
                    .velocity = 0.5 * (from[i].velocity + to[i].velocity),
                    .angularMomentum = 0.5 * (from[i].angularMomentum + to[i].angularMomentum),
                    .time = from[i].time + 0.5 * h};
    }
  }
}

// The first estimate of a step's impulses: by the last forces. Without them bodies at rest would fall, and
// springs and drag be those of a motion that never was.
void ImplicitStep::guessImpulses(const GroupState& from, double h, std::span<const ClosedContact> contacts) {
  features_.clear();
  for (const ClosedContact& contact : contacts) {
    features_.push_back(contact.feature);
  }
  group_.contactsAt(features_, from, geometry_);
  std::vector<Triple> impulses;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    impulses.push_back(impulseOf(contacts[c], geometry_[c].normal, h));
  }
  impulses_.sum(features_, geometry_, impulses, gained_);
}

// Rows at the middle of the step, axes at `to`, the last estimate of its end.
void ImplicitStep::setProblem(const GroupState& from, double h, std::span<const ClosedContact> contacts,
                              const GroupState& to) {
  impulses_.begin(features_, to);
  impulses_.setFree(from, loads_, h);
  group_.contactsAt(features_, middle_, geometry_);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    impulses_.add(features_[c], geometry_[c]);
    impulses_.startFrom(impulseOf(contacts[c], geometry_[c].normal, h));
  }
}

void ImplicitStep::aimAtEnd(const GroupState& to) {
  group_.contactsAt(features_, to, ends_);
  for (std::size_t c = 0; c < features_.size(); ++c) {
    impulses_.aimAtEnd(c, features_[c], geometry_[c], ends_[c], to);
  }
}

void ImplicitStep::takeImpulses(const GroupState& from, double h, std::span<ClosedContact> contacts) {
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Triple& impulse = impulses_.impulses()[c];
    if (features_[c].isTwoSided()) {
      contacts[c].friction = Vec3(impulse[0], impulse[1], impulse[2]) / h;
      contacts[c].push = contacts[c].friction.norm();
      continue;
    }
    contacts[c].push = impulse[0] / h;
    contacts[c].friction = frameOf(geometry_[c].normal).across(impulse[1], impulse[2]) / h;
  }
  impulses_.sum(features_, geometry_, impulses_.impulses(), gained_);
  moveArms(from, h);
}

// The points at which the impulses act are those of the last estimate of the middle; the centres of mass are
// by now known to be elsewhere there. About them angular momentum is exchanged exactly.
void ImplicitStep::moveArms(const GroupState& from, double h) {
  for (const std::size_t i : impulses_.movers()) {
    const Vec3 gained = group_.body(i).mass.inverseMass * (h * loads_[i].force + gained_[i].push);
    const Vec3 middle = from[i].position + (0.5 * h) * (from[i].velocity + 0.5 * gained);
    gained_[i].twist += (middle_[i].position - middle).cross(gained_[i].push);
  }
}

bool ImplicitStep::advance(const GroupState& from, double h, std::vector<ClosedContact>& contacts,
                           GroupState& to, Order order) {
  chooseResidual(from);
  residual_ *= order == Order::kFirst ? kLastResort : 1;
  to = from;
  guessImpulses(from, h, contacts);
  loads_.find(from);
  move(from, h, to);
  move(from, h, to);
  // Rows at the middle and law at the end depend on the step's own result: one pass alone is of first order.
  for (int pass = 0; pass < static_cast<int>(order) && (loads_.vary() || !contacts.empty()); ++pass) {
    findMiddle(from, h, to);
    if (loads_.vary()) {
      loads_.find(middle_);
    }
    if (!contacts.empty()) {
      setProblem(from, h, contacts, to);
      if (pass > 0) {
        aimAtEnd(to);
      }
      if (!impulses_.solve(residual_) && !(order == Order::kFirst && impulses_.residual() <= residual_)) {
        return false;
      }
      takeImpulses(from, h, contacts);
    }
    move(from, h, to);
  }
  if (loads_.vary()) {  // the middle where springs pull is itself an estimate
    group_.keepMomenta(from, h, pushing(contacts), to);
  }
  return true;
}

bool ImplicitStep::compress(GroupState& state, std::span<const ContactFeature> contacts,
                            std::vector<Triple>& impulses) {
  chooseResidual(state);
  impulses_.begin(contacts, state);
  impulses_.setFree(state, loads_, 0);
  group_.contactsAt(contacts, state, geometry_);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    impulses_.add(contacts[c], geometry_[c]);
  }
  if (!impulses_.solve(residual_)) {
    return false;
  }
  impulses = impulses_.impulses();
  impulses_.sum(contacts, geometry_, impulses, gained_);
  for (const std::size_t i : impulses_.movers()) {
    state[i].velocity += group_.body(i).mass.inverseMass * gained_[i].push;
    state[i].angularMomentum += gained_[i].twist;
  }
  return true;
}

bool ImplicitStep::separate(GroupState& state, std::span<const ContactFeature> contacts, double deepest) {
  constexpr int kMostPasses = 4;
  const GroupState before = state;
  std::vector<ContactFeature> pushing;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    impulses_.begin(contacts, state);
    bool deep = false;
    group_.contactsAt(contacts, state, geometry_);
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      ContactProblem::Contact& contact = impulses_.add(contacts[c], geometry_[c]);
      contact.friction = 0;
      contact.directions.clear();
      contact.target[0] = -geometry_[c].gap;
      deep = deep || geometry_[c].gap < -deepest;
      if (contacts[c].holds()) {
        const Vec3& gaps = geometry_[c].rows->gaps;
        contact.target = {-gaps[0], -gaps[1], -gaps[2]};
        deep = deep || geometry_[c].gap > deepest;
      }
    }
    if (!deep) {
      break;
    }
    if (!impulses_.solve(kEnoughProgress * tolerance_)) {
      return false;
    }
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      if (contacts[c].holds() || impulses_.impulses()[c][0] > 0) {
        pushing.push_back(contacts[c]);
      }
    }
    for (std::size_t m = 0; m < impulses_.movers().size(); ++m) {
      GroupBody& body = state[impulses_.movers()[m]];
      body.position += impulses_.velocity(m);
      body.worldFromBody = (body.worldFromBody * rotationBy(impulses_.spinBody(m))).normalized();
    }
  }
  if (!pushing.empty()) {
    group_.keepMomenta(before, 0, pushing, state);
  }
  return true;
}

}  // namespace careen
