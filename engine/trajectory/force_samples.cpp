#include "trajectory/force_samples.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "physics/world/forces.h"
#include "trajectory/impact_moment.h"

namespace careen {
namespace {

/// [s] at a crowd's usual tolerance: three of its longest steps. It goes with the tolerance's root, as they
/// do.
constexpr double kWhile = 1.0 / 60;
/// [1] of the tolerance: contacts that push are not farther open.
constexpr double kClosed = 4;
constexpr double kClosedInCrowds = 2;

/// [1] Rounding of the bend of a step's place, and what of the loads it may amount to.
constexpr double kOfRounding = 0x1p-46;
constexpr double kRounded = 0x1p-10;
/// Steps looked at beside one that is too short.
constexpr std::size_t kBeside = 8;

template <class Event>
bool namesAt(const std::vector<Event>& events, double time, const auto& isNamed) {
  const auto isBefore = [](const Event& event, double moment) { return event.time < moment; };
  for (auto event = std::lower_bound(events.begin(), events.end(), time, isBefore);
       event != events.end() && event->time == time; ++event) {
    if (isNamed(*event)) {
      return true;
    }
  }
  return false;
}

}  // namespace

ForceSamples::ForceSamples(const Trajectory& run)
    : run_(run), while_(kWhile * std::sqrt(run.settings.crowds.tolerance / CrowdSettings{}.tolerance)) {
  for (const Track& track : run.tracks) {
    const auto first = std::find_if(track.segments.begin(), track.segments.end(), [](const Segment& segment) {
      return std::holds_alternative<CrowdStep>(segment.motion);
    });
    crowdFrom_.push_back(first != track.segments.end() ? first->start : Joint::kFree);
  }
}

ForceSamples::Momentum ForceSamples::momentumOf(std::size_t body, const BodyState& state) const {
  return {.linear = run_.world.bodies[body].mass.mass * state.velocity, .angular = state.angularMomentum};
}

// Its gravity and what its joints do then.
World ForceSamples::worldAt(double time) const {
  World world = run_.world;
  world.gravity = gravityAt(run_.world, time);
  for (const JointEffort& effort : run_.jointEfforts) {
    if (effort.time <= time) {
      world.joints[static_cast<std::size_t>(effort.joint)].effort = effort.effort;
    }
  }
  for (Joint& joint : world.joints) {
    if (joint.until <= time) {
      joint.stiffness = joint.damping = joint.effort = joint.grip = 0;
    }
  }
  return world;
}

bool ForceSamples::isInCrowd(std::size_t body, double from, double to) const {
  const Segments& segments = run_.tracks[body].segments;
  bool found = false;
  if (crowdFrom_[body] <= to) {
    const std::size_t last = segments.countUntil(to);
    for (std::size_t k = std::max<std::size_t>(segments.countUntil(from), 1) - 1; k < last; ++k) {
      found = found || std::holds_alternative<CrowdStep>(segments[k].motion);
    }
  }
  return found;
}

bool ForceSamples::isStruck(std::size_t body, double time) const {
  const auto isNamed = [&](const auto& event) {
    std::vector<int> named;
    if constexpr (requires { event.joint; }) {
      addNamed(run_.world.joints[static_cast<std::size_t>(event.joint)], named);
    } else {
      addNamed(event, named);
    }
    return std::find(named.begin(), named.end(), static_cast<int>(body)) != named.end();
  };
  return namesAt(run_.impacts, time, isNamed) || namesAt(run_.jointImpulses, time, isNamed);
}

// Without impacts outside the crowd.
MomentumRates ForceSamples::meanRates(std::size_t body, double from, double to) const {
  const Segments& segments = run_.tracks[body].segments;
  const MassProperties& mass = run_.world.bodies[body].mass;
  const auto at = [&](double time) {
    return momentumOf(body, time <= 0 ? run_.world.bodies[body].initial : run_.state(body, time));
  };
  const Momentum first = at(from);
  const Momentum last = at(to);
  Momentum gained{.linear = last.linear - first.linear, .angular = last.angular - first.angular};
  for (std::size_t k = std::max<std::size_t>(segments.countUntil(from), 1); k < segments.countUntil(to);
       ++k) {
    const Segment before = segments[k - 1];
    const Segment after = segments[k];
    if (!std::holds_alternative<CrowdStep>(before.motion) &&
        !std::holds_alternative<CrowdStep>(after.motion) && isStruck(body, after.start)) {
      const Momentum came = momentumOf(body, stateAt(before.motion, mass, after.start - before.start));
      const Momentum goes = momentumOf(body, stateAt(after.motion, mass, 0));
      gained.linear -= goes.linear - came.linear;
      gained.angular -= goes.angular - came.angular;
    }
  }
  return {.linear = gained.linear / (to - from), .angular = gained.angular / (to - from)};
}

// Of a step so short that its bend is rounding, those of the next that is longer, else of the last.
MomentumRates ForceSamples::ratesInContact(std::size_t body, std::size_t place, double time,
                                           double load) const {
  const Segments& segments = run_.tracks[body].segments;
  const MassProperties& mass = run_.world.bodies[body].mass;
  const auto known = [&](std::size_t k, double moment) -> std::optional<MomentumRates> {
    const Segment segment = segments[k];
    const ContactStep* const step = std::get_if<ContactStep>(&segment.motion);
    if (step == nullptr) {
      return std::nullopt;
    }
    const MomentumRates rates = momentumRatesAt(*step, mass, moment - segment.start);
    const double rounding =
        kOfRounding * mass.mass * step->position[0].norm() / (step->duration * step->duration);
    return rounding <= kRounded * (load > 0 ? load : rates.linear.norm()) ? std::optional(rates)
                                                                          : std::nullopt;
  };
  std::optional<MomentumRates> rates = known(place, time);
  for (std::size_t k = place + 1; !rates && k < std::min(segments.size(), place + kBeside); ++k) {
    rates = known(k, segments[k].start);
  }
  for (std::size_t k = place; !rates && k > place - std::min(place, kBeside); --k) {
    rates = known(k - 1, segments[k].start);
  }
  return rates.value_or(MomentumRates{});
}

PushedBody ForceSamples::pushed(std::size_t body, double time, const BodyState& state,
                                const Load& load) const {
  PushedBody found{.state = state};
  const Body& moved = run_.world.bodies[body];
  if (isImmovable(moved.mass)) {
    return found;
  }
  const double from = std::max(0.0, time - 0.5 * while_);
  const double to = std::min(run_.settings.duration, time + 0.5 * while_);
  Load acting = load;
  MomentumRates rates;
  if (isInCrowd(body, from, to)) {
    rates = meanRates(body, from, to);
    acting.force += moved.mass.mass * (meanGravity(run_.world, from, to) - gravityAt(run_.world, time));
    found.over = 0.5 * while_;
  } else {
    const Segments& segments = run_.tracks[body].segments;
    const std::size_t place = std::max<std::size_t>(segments.countUntil(time), 1) - 1;
    const Motion motion = segments[place].motion;
    if (std::holds_alternative<ContactStep>(motion)) {
      rates = ratesInContact(body, place, time, load.force.norm());
    } else if (!std::holds_alternative<Rest>(motion)) {
      return found;
    }
  }
  // What a crowd left at rest lies as it did in it.
  const bool isOfCrowd = crowdFrom_[body] <= to;
  found.touches = isOfCrowd ? PushedBody::Touches::kInCrowd : PushedBody::Touches::kExactly;
  found.near =
      isOfCrowd ? kClosedInCrowds * run_.settings.crowds.tolerance : kClosed * run_.settings.tolerance;
  found.given = {.force = rates.linear - acting.force, .torque = rates.angular - acting.torque};
  found.scale = rates.linear.norm() + acting.force.norm() +
                (rates.angular.norm() + acting.torque.norm()) / radiusOf(moved);
  found.slow = std::sqrt(found.near * found.scale * moved.mass.inverseMass);
  return found;
}

std::vector<ContactPush> ForceSamples::at(double time) const {
  const std::vector<BodyState> states = run_.states(time);
  const World world = worldAt(time);
  std::vector<Load> loads;
  computeLoads(world, world.gravity, states, loads);
  std::vector<PushedBody> bodies;
  for (std::size_t body = 0; body < states.size(); ++body) {
    bodies.push_back(pushed(body, time, states[body], loads[body]));
  }
  return contactPushes(world, bodies, time);
}

std::string partnerName(const Trajectory& run, const ContactPush& push) {
  return !push.b            ? std::string()
         : push.b->isWall() ? run.world.walls[push.b->wall()].name
                            : run.world.bodies[static_cast<std::size_t>(push.b->body())].name;
}

}  // namespace careen
