#include "physics/contact/touching_group.h"

#include <algorithm>

#include "physics/contact/group_momentum.h"

namespace careen {
namespace {

GroupBody groupBodyOf(const TouchingBody& driven) {
  const BodyState state = driven.state();
  return {.position = driven.position,
          .worldFromBody = driven.worldFromBody,
          .velocity = state.velocity,
          .angularMomentum = state.angularMomentum,
          .time = driven.time};
}

}  // namespace

GroupState TouchingGroup::state() const {
  GroupState all;
  for (const TouchingBody& body : bodies_) {
    if (body.isDriven()) {
      all.push_back(groupBodyOf(body));
      continue;
    }
    const BodyState state = body.state();
    all.push_back({.position = body.position,
                   .worldFromBody = body.worldFromBody,
                   .velocity = body.isHeld() ? Vec3(Vec3::Zero()) : state.velocity,
                   .angularMomentum = body.isHeld() ? Vec3(Vec3::Zero()) : state.angularMomentum,
                   .time = body.time});
  }
  return all;
}

GroupBody TouchingGroup::drivenFrom(const GroupState& from, std::size_t body, double h) const {
  return groupBodyOf(drivenAt(bodies_[body], from[body].time + h));
}

void TouchingGroup::drive(const GroupState& from, double h, GroupState& to) const {
  for (std::size_t i = 0; i < size(); ++i) {
    if (isDriven(i)) {
      to[i] = drivenFrom(from, i, h);
    }
  }
}

Vec3 TouchingGroup::angularVelocity(std::size_t body, const Mat3& worldFromBody,
                                    const Vec3& angularMomentum) const {
  return worldFromBody *
         bodies_[body].body->mass.inverseInertiaTimes(worldFromBody.transpose() * angularMomentum);
}

Kinematics TouchingGroup::kinematics(std::size_t body, const GroupBody& at) const {
  if (isDriven(body)) {
    return bodies_[body].drivenBy->at(at.time);
  }
  Kinematics kinematics{.pose = at.pose()};
  if (!isHeld(body)) {
    kinematics.velocity = at.velocity;
    kinematics.angularVelocity = angularVelocity(body, kinematics.pose.worldFromBody, at.angularMomentum);
  }
  return kinematics;
}

double TouchingGroup::fastest(const GroupState& state) const {
  double fastest = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    if (!isHeld(i)) {
      const Kinematics at = kinematics(i, state[i]);
      fastest = std::max(fastest, at.velocity.norm() + at.angularVelocity.norm() * radiusOf(body(i)));
    }
  }
  return fastest;
}

bool TouchingGroup::mayMeet(std::size_t a, std::size_t b, const GroupState& state, double within) const {
  const double reach = radiusOf(body(a)) + radiusOf(body(b)) + within;
  return !(isHeld(a) && isHeld(b)) && mayTouch(world_, bodies_[a].index, bodies_[b].index) &&
         (state[a].position - state[b].position).squaredNorm() <= reach * reach;
}

ContactState TouchingGroup::stateOf(const ContactFeature& feature, const Kinematics& a,
                                    const Kinematics& b) const {
  const TouchingBody& bodyA = bodies_[static_cast<std::size_t>(feature.a)];
  const TouchingBody& bodyB = bodies_[static_cast<std::size_t>(feature.b)];
  ContactState at = contactState(feature, a, bodyA.shape(feature.boxA), b, bodyB.shape(feature.boxB));
  if (bodyB.isBox() && !feature.isOfJoint()) {  // one point for both, else their impulses would change
                                                // angular momentum by gap × friction
    const Vec3 link = (a.pose.position - b.pose.position) + (at.armA - at.armB);
    at.armA -= 0.5 * link;
    at.armB += 0.5 * link;
  }
  return at;
}

ContactState TouchingGroup::contactAt(const ContactFeature& feature, const GroupState& state) const {
  const auto a = static_cast<std::size_t>(feature.a);
  const auto b = static_cast<std::size_t>(feature.b);
  return stateOf(feature, kinematics(a, state[a]), kinematics(b, state[b]));
}

void TouchingGroup::contactsAt(std::span<const ContactFeature> features, const GroupState& state,
                               std::vector<ContactState>& contacts) {
  kinematics_.resize(size());
  for (std::size_t i = 0; i < size(); ++i) {
    kinematics_[i] = kinematics(i, state[i]);
  }
  contacts.clear();
  for (const ContactFeature& feature : features) {
    contacts.push_back(stateOf(feature, kinematics_[static_cast<std::size_t>(feature.a)],
                               kinematics_[static_cast<std::size_t>(feature.b)]));
  }
  normals_.align(features, {}, contacts);
}

void TouchingGroup::keepMomenta(const GroupState& before, double h, std::span<const ContactFeature> pushing,
                                GroupState& to) const {
  const auto mover =
      std::find_if(bodies_.begin(), bodies_.end(), [](const TouchingBody& body) { return !body.isHeld(); });
  if (mover == bodies_.end()) {
    return;
  }
  const double time = before[static_cast<std::size_t>(mover - bodies_.begin())].time;
  const auto stateIn = [](const GroupState& all) { return [&all](std::size_t i) { return all[i].state(); }; };
  for (const auto& [i, change] :
       changesToKeep(world_, bodies_, pushing, time, h, stateIn(before), stateIn(to))) {
    GroupBody& at = to[i];
    at.velocity += change.velocityAt(at.position);
    at.position += change.shift;
    at.angularMomentum += careen::angularMomentum(body(i).mass, at.pose().worldFromBody, change.turning);
  }
}

}  // namespace careen
