#include "physics/contact/contact_impulses.h"

#include <array>
#include <string>

#include "core/error.h"
#include "core/math/order_free_sum.h"
#include "physics/contact/three_at.h"
#include "physics/geometry/contact_frame.h"
#include "physics/solver/contact_rows.h"

namespace careen {

void ContactImpulses::begin(std::span<const ContactFeature> contacts, const GroupState& turned) {
  places_.assign(group_.size(), ContactProblem::kNobody);
  movers_.clear();
  problem_.inverseMass.clear();
  problem_.contacts.clear();
  length_ = 0;
  solution_.impulses.clear();
  std::vector<char> touched(group_.size(), 0);
  for (const ContactFeature& feature : contacts) {
    touched[static_cast<std::size_t>(feature.a)] = 1;
    touched[static_cast<std::size_t>(feature.b)] = 1;
  }
  for (std::size_t i = 0; i < group_.size(); ++i) {
    if (touched[i] != 0 && !group_.isHeld(i)) {
      places_[i] = static_cast<int>(movers_.size());
      movers_.push_back(i);
      const MassProperties& mass = group_.body(i).mass;
      turned_[i] = mass.worldFromPrincipal(turned[i].worldFromBody.toRotationMatrix());
      problem_.inverseMass.insert(problem_.inverseMass.end(), 3, mass.inverseMass);
      for (int k = 0; k < 3; ++k) {
        problem_.inverseMass.push_back(mass.inverseInertiaBody[k]);
      }
    }
  }
  problem_.free.assign(problem_.inverseMass.size(), 0.0);
}

void ContactImpulses::setFree(const GroupState& from, const GroupLoads& loads, double h) {
  length_ = h;
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    const std::size_t i = movers_[m];
    const MassProperties& mass = group_.body(i).mass;
    setThree(problem_.free, m * kSix, from[i].velocity + (h * mass.inverseMass) * loads[i].force);
    const Vec3 angular = from[i].angularMomentum + h * loads[i].torque;
    setThree(problem_.free, m * kSix + 3,
             mass.inverseInertiaBody.cwiseProduct(turned_[i].transpose() * angular));
  }
}

ContactProblem::Contact& ContactImpulses::add(const ContactFeature& feature, const ContactState& geometry) {
  ContactProblem::Contact contact;
  const ContactFrame frame = frameOf(geometry.normal);
  const auto addSide = [&](std::size_t body, std::size_t side) {
    if (places_[body] != ContactProblem::kNobody) {
      setSide(contact, side, side == 0 ? geometry.sideA(frame) : geometry.sideB(frame), turned_[body]);
    }
    return places_[body];
  };
  contact.a = addSide(static_cast<std::size_t>(feature.a), 0);
  contact.b = addSide(static_cast<std::size_t>(feature.b), 1);
  contact.admissible = feature.admissible();
  contact.most = length_ * geometry.grip;
  contact.least = -contact.most;
  contact.target = geometry.target(frame);
  contact.friction = feature.material.friction;
  for (const Vec3& direction : geometry.directions) {
    contact.directions.push_back(frame.along(direction));
  }
  problem_.contacts.push_back(contact);
  return problem_.contacts.back();
}

void ContactImpulses::aimAtEnd(std::size_t index, const ContactFeature& feature, const ContactState& geometry,
                               const ContactState& end, const GroupState& to) {
  ContactProblem::Contact& contact = problem_.contacts[index];
  const ContactFrame frame = frameOf(geometry.normal);
  const Vec3 actual = end.rows ? Vec3(end.rows->rates - Vec3(end.kept, 0, 0))
                               : Vec3(end.rate, dot(end.slip, frame.tangent1), dot(end.slip, frame.tangent2));
  for (std::size_t row = 0; row < 3; ++row) {
    double speed = 0;
    const std::array<int, 2> sides{contact.a, contact.b};
    const std::array<int, 2> bodies{feature.a, feature.b};
    for (std::size_t side = 0; side < 2; ++side) {
      if (sides[side] == ContactProblem::kNobody) {
        continue;
      }
      const auto i = static_cast<std::size_t>(bodies[side]);
      const Vec3 spin =
          group_.body(i).mass.inverseInertiaBody.cwiseProduct(turned_[i].transpose() * to[i].angularMomentum);
      speed += dot(threeAt(contact.rows[row], side * kSix), to[i].velocity) +
               dot(threeAt(contact.rows[row], side * kSix + 3), spin);
    }
    contact.target[row] = speed - actual[static_cast<Eigen::Index>(row)];
  }
}

bool ContactImpulses::solve(double enough) {
  solution_.enough = enough;
  const bool solved = solver_.solve(problem_, solution_);
  work_ += solution_.factorisations * static_cast<double>(movers_.size() + problem_.contacts.size());
  if (work_ > mostWork_) {
    throw NumericalError("a step of " + std::to_string(movers_.size()) + " bodies in contact costs too much");
  }
  return solved;
}

Vec3 ContactImpulses::velocity(std::size_t mover) const {
  return threeAt(solution_.velocities, mover * kSix);
}

Vec3 ContactImpulses::spinBody(std::size_t mover) const {
  return group_.body(movers_[mover]).mass.fromPrincipal(threeAt(solution_.velocities, mover * kSix + 3));
}

// Sums over contacts do not depend on their order, which names and mirroring change.
void ContactImpulses::sum(std::span<const ContactFeature> contacts, std::span<const ContactState> geometry,
                          std::span<const Triple> impulses, std::vector<BodyImpulse>& sums) {
  parts_.resize(group_.size());
  for (auto& parts : parts_) {
    parts.clear();
  }
  const auto addRows = [&](std::size_t body, const RowSide& side, const Triple& impulse) {
    if (!group_.isHeld(body)) {
      const BodyImpulse sum = impulseOf(side, impulse);
      parts_[body].push_back(
          {sum.push[0], sum.push[1], sum.push[2], sum.twist[0], sum.twist[1], sum.twist[2]});
    }
  };
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (geometry[c].rows) {
      addRows(static_cast<std::size_t>(contacts[c].a), geometry[c].rows->a, impulses[c]);
      addRows(static_cast<std::size_t>(contacts[c].b), geometry[c].rows->b, impulses[c]);
      continue;
    }
    const Vec3 push = frameOf(geometry[c].normal).inWorld(impulses[c]);
    const auto add = [&](std::size_t body, const Vec3& arm, double sign) {
      if (!group_.isHeld(body)) {
        const Vec3 twist = sign * arm.cross(push);
        parts_[body].push_back(
            {sign * push[0], sign * push[1], sign * push[2], twist[0], twist[1], twist[2]});
      }
    };
    add(static_cast<std::size_t>(contacts[c].a), geometry[c].armA, 1);
    add(static_cast<std::size_t>(contacts[c].b), geometry[c].armB, -1);
  }
  sums.resize(group_.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const std::array<double, kSix> all = orderFreeSums<kSix>(parts_[i]);
    sums[i] = {.push = {all[0], all[1], all[2]}, .twist = {all[3], all[4], all[5]}};
  }
}

}  // namespace careen
