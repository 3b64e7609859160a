#include "trajectory/energy_losses.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/world/forces.h"
#include "trajectory/impact_moment.h"

namespace careen {
namespace {

/// Gauss–Legendre with five nodes on [0, 1]: the roots are ½ ± ⅙ √(5 ∓ 2 √(10/7)), and ½.
struct GaussNode {
  double place;
  double weight;
};
constexpr std::array<GaussNode, 5> kNodes = {{{0.04691007703066800, 0.11846344252809454},
                                              {0.23076534494715845, 0.23931433524968324},
                                              {0.5, 0.28444444444444444},
                                              {0.76923465505284155, 0.23931433524968324},
                                              {0.95308992296933200, 0.11846344252809454}}};

}  // namespace

LossesOfRun::LossesOfRun(const Trajectory& run) : run_(run) {
  for (const Body& body : run.world.bodies) {
    states_.push_back(body.initial);
  }
  addTakers();
}

void LossesOfRun::addTakers() {
  const World& world = run_.world;
  for (const Spring& spring : world.springs) {
    if (spring.damping != 0) {
      takers_.push_back({.bodies = {spring.from.body, spring.to.body},
                         .kind = &EnergyLosses::damping,
                         .power = [&](std::span<const BodyState> states) {
                           const double rate = stretchOf(spring, world, states).rate;
                           return spring.damping * rate * rate;
                         }});
    }
  }
  for (const Joint& joint : world.joints) {
    const auto add = [&](double EnergyLosses::*kind, double (*power)(const Joint& of, double rate)) {
      takers_.push_back({.bodies = {joint.from.body, joint.to.body},
                         .kind = kind,
                         .power =
                             [&joint, &world, power](std::span<const BodyState> states) {
                               return power(joint, jointMotionOf(joint, world, states).rate);
                             },
                         .end = joint.until});
    };
    if (joint.damping != 0) {
      add(&EnergyLosses::damping, [](const Joint& of, double rate) { return of.damping * rate * rate; });
    }
    if (joint.grip != 0 && joint.keptRate == 0) {
      add(&EnergyLosses::jointFriction,
          [](const Joint& of, double rate) { return of.grip * std::fabs(rate); });
    }
  }
  for (std::size_t body = 0; world.drag && body < world.bodies.size(); ++body) {
    if (!isImmovable(world.bodies[body].mass)) {
      takers_.push_back({.bodies = {static_cast<int>(body), std::nullopt},
                         .kind = &EnergyLosses::drag,
                         .power = [&world, body](std::span<const BodyState> states) {
                           const Vec3& velocity = states[body].velocity;
                           const Vec3 spin = angularVelocity(world.bodies[body].mass, states[body]);
                           const Load load = dragLoad(*world.drag, velocity, spin);
                           return -dot(load.force, velocity) - dot(load.torque, spin);
                         }});
    }
  }
}

double LossesOfRun::integral(const Taker& taker, double from, double to) {
  double sum = 0;
  for (const GaussNode& node : kNodes) {
    const double time = from + node.place * (to - from);
    for (const std::optional<int>& body : taker.bodies) {
      if (body) {
        states_[static_cast<std::size_t>(*body)] = run_.state(static_cast<std::size_t>(*body), time);
      }
    }
    sum += node.weight * taker.power(states_);
  }
  return (to - from) * sum;
}

// Piece by piece: in none of them does a motion end.
void LossesOfRun::follow(Taker& taker, double time) {
  const double last = std::min(time, taker.end);
  while (taker.since < last) {
    double next = last;
    for (const std::optional<int>& body : taker.bodies) {
      if (body) {
        const Segments& segments = run_.tracks[static_cast<std::size_t>(*body)].segments;
        const std::size_t begun = segments.countUntil(taker.since);
        next = begun < segments.size() ? std::min(next, segments[begun].start) : next;
      }
    }
    lost_.*taker.kind += integral(taker, taker.since, next);
    taker.since = next;
  }
}

// All that is recorded at that moment.
void LossesOfRun::strike(double time) {
  std::vector<int> named;
  for (; nextImpact_ < run_.impacts.size() && run_.impacts[nextImpact_].time <= time; ++nextImpact_) {
    addNamed(run_.impacts[nextImpact_], named);
  }
  for (; nextPassed_ < run_.jointImpulses.size() && run_.jointImpulses[nextPassed_].time <= time;
       ++nextPassed_) {
    addNamed(run_.world.joints[static_cast<std::size_t>(run_.jointImpulses[nextPassed_].joint)], named);
  }
  for (const StruckBody& struck : struckBodies(run_, std::move(named), time)) {
    const MassProperties& mass = run_.world.bodies[struck.body].mass;
    lost_.impacts += kineticEnergy(mass, struck.before) - kineticEnergy(mass, struck.after);
  }
}

EnergyLosses LossesOfRun::until(double time) {
  while (true) {
    double next = Joint::kFree;  // [s]
    if (nextImpact_ < run_.impacts.size()) {
      next = run_.impacts[nextImpact_].time;
    }
    if (nextPassed_ < run_.jointImpulses.size()) {
      next = std::min(next, run_.jointImpulses[nextPassed_].time);
    }
    if (!(next <= time)) {
      break;
    }
    strike(next);
  }
  for (Taker& taker : takers_) {
    follow(taker, time);
  }
  return lost_;
}

}  // namespace careen
