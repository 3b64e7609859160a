#include "audit/ledger.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "audit/external.h"
#include "audit/least_of_late.h"
#include "audit/seams.h"
#include "physics/world/forces.h"
#include "trajectory/motor_work.h"

namespace careen {
namespace {

constexpr double kUlps = 1024 * std::numeric_limits<double>::epsilon();
// A group that hardly moves is compared with this part of what falling by its own size would give it.
constexpr double kStill = 1.0 / 64;
// A group that moves without turning is compared with this part of its momentum times its size; a crowd with
// kStill, as its places are only right to its tolerance.
constexpr double kOfMotion = 0x1p-20;
// A group whose members' angular momenta cancel is compared with this part of theirs.
constexpr double kOfMembers = 1.0 / 8;
constexpr double kOfSpeed = 24.0 / 7;  // see spinWithinSteps
constexpr double kMean = 1.0 / 30;     // [s] six of a crowd's longest steps, at its usual tolerance
constexpr double kParallel = 1e-9;     // [1] walls whose normals differ by less have the same

/// What a group has at a moment, and the scales that its changes are compared with.
struct Holdings {
  Vec3 momentum = Vec3::Zero();         // [kg m/s]
  Vec3 angularMomentum = Vec3::Zero();  // [kg m²/s] about the group's origin
  double energy = 0;                    // [J] kinetic, gravitational from the origin, of springs
  double momentumScale = 0;
  double angularScale = 0;
  double spin =
      0;  // [kg m²/s] of the angular momentum about its centre of mass, which its members' may cancel in
  double energyScale = 0;  // kinetic and of springs
  double far = 0;          // [m] largest coordinate
  double turned = 0;       // [kg m²/s] of the whole group about the origin
  double weight = 0;       // [N]

  bool isFinite() const { return std::isfinite(energy + momentum.sum() + angularMomentum.sum()); }
};

class Books {
 public:
  Books(const Trajectory& run, const Samples& samples, const ExchangeGroup& group,
        const std::vector<double>& fallingSpeeds, Findings& findings)
      : run_(run),
        samples_(samples),
        group_(group),
        fallingSpeeds_(fallingSpeeds),
        findings_(findings),
        motors_(run, group.joints),
        span_(kMean * std::sqrt(run.settings.crowds.tolerance / CrowdSettings{}.tolerance)),
        momentum_(span_),
        angularMomentum_(momentum_),
        rise_(momentum_),
        fall_(momentum_) {}

  void check();

 private:
  double mass(std::size_t body) const { return run_.world.bodies[body].mass.mass; }
  template <class StateOf>
  Vec3 center(const StateOf& stateOf) const;
  template <class StateOf>
  Holdings holdings(const StateOf& stateOf, double springs, const Vec3& gravity) const;
  Vec3 gravityUntil(std::size_t moment) const;
  Holdings at(std::size_t moment) const;
  double springEnergyAt(std::size_t moment) const;
  double reachAt(std::size_t moment) const;
  void include(const Holdings& now);
  void changeGravity(std::size_t moment);
  void spreadBelts(std::vector<External>& externals) const;
  void give(double energy);
  void addWorkOfBelts(const Holdings& now, const External& external);
  void balance(double time, const Holdings& now, External& external);
  void balanceMomentum(double time, const Holdings& now, const External& external);
  void balanceAngularMomentum(double time, const Holdings& now, const External& external);
  void balanceEnergy(double time, const Holdings& now, const External& external);
  bool isCrowd(double time) const { return !run_.given && findings_.isCrowd(time, group_.bodies); }
  double lasting(LeastOfLate& late, double time, double amount) const {
    const double least = late.with(time, amount);
    return isCrowd(time) ? least : amount;
  }
  double spinWithinSteps(double time) const;
  void report(AuditKind kind, double time, double amount, double scale, double rounding);

  const Trajectory& run_;
  const Samples& samples_;
  const ExchangeGroup& group_;
  const std::vector<double>& fallingSpeeds_;
  Findings& findings_;
  MotorWork motors_;
  Vec3 origin_ = Vec3::Zero();
  Holdings due_;
  Vec3 momentumBefore_ = Vec3::Zero();  // [kg m/s] at the last moment
  Holdings largest_;                    // its scales only
  double reach_ = 0;                    // [m] from its middle to its farthest body
  bool takesEnergy_ = false;
  double span_;  // [s] over which speeds of crowds are means
  // A crowd's speeds are means over steps, near 0 where a body bounces, and other engines store energy in
  // contacts: of such, only what lasts counts.
  LeastOfLate momentum_;
  LeastOfLate angularMomentum_;
  LeastOfLate rise_;
  LeastOfLate fall_;
  // Nothing but gravity, drag and springs acts on it from outside, ever. A crowd's walls act in the middle of
  // a step, and their impulses are recorded at its end.
  bool alone_ = true;
  double length_ = std::numeric_limits<double>::infinity();  // [m] that the tolerance is relative to
};

template <class StateOf>
Vec3 Books::center(const StateOf& stateOf) const {
  Vec3 sum = Vec3::Zero();
  double all = 0;
  for (const std::size_t body : group_.bodies) {
    sum += mass(body) * stateOf(body).pose.position;
    all += mass(body);
  }
  return sum / all;
}

template <class StateOf>
Holdings Books::holdings(const StateOf& stateOf, double springs, const Vec3& gravity) const {
  Holdings now;
  double all = 0;
  for (const std::size_t body : group_.bodies) {
    now.momentum += mass(body) * stateOf(body).velocity;
    all += mass(body);
  }
  const Vec3 middle = center(stateOf);
  const Vec3 drift = now.momentum / all;
  for (const std::size_t body : group_.bodies) {
    const BodyState& state = stateOf(body);
    const Vec3 arm = state.pose.position - origin_;
    const double kinetic = kineticEnergy(run_.world.bodies[body].mass, state);
    now.angularMomentum += state.angularMomentum + mass(body) * arm.cross(state.velocity);
    now.energy += kinetic - mass(body) * gravity.dot(arm);
    now.momentumScale += mass(body) * state.velocity.norm();
    now.angularScale += state.angularMomentum.norm() +
                        mass(body) * (state.pose.position - middle).norm() * (state.velocity - drift).norm();
    now.energyScale += kinetic;
    now.far = std::max(now.far, state.pose.position.norm());
    now.turned += mass(body) * arm.norm() * state.velocity.norm();
  }
  now.spin = (now.angularMomentum - (middle - origin_).cross(now.momentum)).norm();
  now.energy += springs;
  now.energyScale += springs;
  return now;
}

Holdings Books::at(std::size_t moment) const {
  return holdings([&](std::size_t body) -> const BodyState& { return samples_.state(moment, body); },
                  springEnergyAt(moment), gravityUntil(moment));
}

// [m/s²] That by which the energy at a moment counts: of one at which it jumps, what was before.
Vec3 Books::gravityUntil(std::size_t moment) const {
  if (run_.world.gravityPath == GravityPath::kLinear) {
    return gravityAt(run_.world, samples_.times()[moment]);
  }
  return gravityAt(run_.world, moment == 0 ? 0 : samples_.times()[moment - 1]);
}

// Gravity changes at that moment, and with it what the group may yet fall by.
void Books::changeGravity(std::size_t moment) {
  if (moment + 1 >= samples_.moments() || run_.world.gravityPath == GravityPath::kLinear) {
    return;
  }
  const Vec3 change = gravityUntil(moment + 1) - gravityUntil(moment);
  if (change.isZero(0)) {
    return;
  }
  double given = 0;
  for (const std::size_t body : group_.bodies) {
    given -= mass(body) * change.dot(samples_.state(moment, body).pose.position - origin_);
  }
  give(given);
}

// [J] From now on it has so much more, and would have had.
void Books::give(double energy) {
  if (energy == 0) {
    return;
  }
  due_.energy += energy;
  fall_.shift(-energy);
}

double Books::springEnergyAt(std::size_t moment) const {
  const auto isSprung = [&](std::size_t index) {
    const Joint& joint = run_.world.joints[index];
    return joint.stiffness != 0 && samples_.times()[moment] < joint.until;
  };
  if (group_.springs.empty() && std::none_of(group_.joints.begin(), group_.joints.end(), isSprung)) {
    return 0;
  }
  std::vector<BodyState> states(run_.world.bodies.size());
  for (std::size_t body = 0; body < states.size(); ++body) {
    states[body] = samples_.state(moment, body);
  }
  double energy = 0;
  for (const std::size_t index : group_.springs) {
    const Spring& spring = run_.world.springs[index];
    const double extension = stretchOf(spring, run_.world, states).length - spring.restLength;
    energy += 0.5 * spring.stiffness * extension * extension;
  }
  for (const std::size_t index : group_.joints) {
    if (isSprung(index)) {
      const Joint& joint = run_.world.joints[index];
      const double extension = jointMotionOf(joint, run_.world, states).coordinate - joint.rest;
      energy += 0.5 * joint.stiffness * extension * extension;
    }
  }
  return energy;
}

double Books::reachAt(std::size_t moment) const {
  const Vec3 middle =
      center([&](std::size_t body) -> const BodyState& { return samples_.state(moment, body); });
  double reach = 0;
  for (const std::size_t body : group_.bodies) {
    reach = std::max(reach, (samples_.state(moment, body).pose.position - middle).norm() +
                                radiusOf(run_.world.bodies[body]));
  }
  return reach;
}

void Books::include(const Holdings& now) {
  largest_.momentumScale = std::max(largest_.momentumScale, now.momentumScale);
  largest_.angularScale = std::max(largest_.angularScale, now.angularScale);
  largest_.spin = std::max(largest_.spin, now.spin);
  largest_.energyScale = std::max(largest_.energyScale, now.energyScale);
  largest_.far = std::max(largest_.far, now.far);
  largest_.turned = std::max(largest_.turned, now.turned);
}

void Books::check() {
  origin_ = center([&](std::size_t body) -> const BodyState& { return samples_.state(0, body); });
  takesEnergy_ = run_.world.drag.has_value() || group_.jointsLose ||
                 std::any_of(group_.springs.begin(), group_.springs.end(),
                             [&](std::size_t spring) { return run_.world.springs[spring].damping != 0; }) ||
                 std::any_of(group_.joints.begin(), group_.joints.end(), [&](std::size_t index) {
                   const Joint& joint = run_.world.joints[index];
                   // One that lets go takes its spring's along.
                   return joint.damping != 0 || joint.grip != 0 ||
                          (joint.stiffness != 0 && joint.until <= run_.settings.duration);
                 });
  std::vector<Holdings> all;
  for (std::size_t moment = 0; moment < samples_.moments(); ++moment) {
    all.push_back(at(moment));
    if (!all.back().isFinite()) {
      return;  // found elsewhere
    }
    include(all.back());
    reach_ = std::max(reach_, reachAt(moment));
  }
  Holdings still;
  double smallest = std::numeric_limits<double>::infinity();
  for (const std::size_t body : group_.bodies) {
    const double size = run_.world.bodies[body].halfExtents.norm();
    smallest = std::min(smallest, size);
    const double momentum = mass(body) * fallingSpeeds_[body];
    still.momentumScale += kStill * momentum;
    still.angularScale += kStill * momentum * size;
    largest_.weight += mass(body) * mostGravity(run_.world);
    still.energyScale += kStill * 0.5 * momentum * fallingSpeeds_[body];
  }
  include(still);
  // Only contact depends on the tolerance.
  if (std::any_of(group_.bodies.begin(), group_.bodies.end(), [&](std::size_t body) {
        const Segments& segments = run_.tracks[body].segments;
        return std::any_of(segments.begin(), segments.end(),
                           [](const Segment& segment) { return mayTouch(segment.motion); });
      })) {
    length_ = smallest;
  }
  ExternalOf following(run_, group_, origin_);
  following.until(samples_.times().front());
  std::vector<External> externals;
  for (std::size_t moment = 1; moment < all.size(); ++moment) {
    externals.push_back(following.until(samples_.times()[moment]));
    const External& external = externals.back();
    alone_ = alone_ && external.walls.empty() && !external.liesOnImmovable && !external.isHeld &&
             !external.isStruck;
  }
  spreadBelts(externals);
  due_ = all.front();
  if (isCrowd(samples_.times().front())) {  // perhaps in the midst of an impact
    due_ = holdings([&](std::size_t body) -> const BodyState& { return run_.world.bodies[body].initial; },
                    springEnergyAt(0), gravityUntil(0));
  }
  momentumBefore_ = due_.momentum;
  momentum_.with(samples_.times().front(), 0);
  angularMomentum_.with(samples_.times().front(), 0);
  rise_.with(samples_.times().front(), 0);
  fall_.with(samples_.times().front(), -due_.energy);
  for (std::size_t moment = 1; moment < all.size(); ++moment) {
    balance(samples_.times()[moment], all[moment], externals[moment - 1]);
    changeGravity(moment);
  }
}

// A wall whose surface moves, or a box that moves evenly, does the work of all that acted along its way from
// outside but is known; others may have done any.
void Books::addWorkOfBelts(const Holdings& now, const External& external) {
  const bool isMoved = external.belt && !external.belt->isZero(0);
  if (external.hasUnknownBelts || (isMoved && external.isHeld)) {
    due_.energy = std::max(due_.energy, now.energy);
  } else if (isMoved) {
    give(external.work + external.belt->dot(now.momentum - momentumBefore_ - external.impulse));
  }
  momentumBefore_ = now.momentum;
}

// What a crowd's member touches acts on it over some steps, before and after: velocities are means.
void Books::spreadBelts(std::vector<External>& externals) const {
  if (std::none_of(externals.begin(), externals.end(), [](const External& each) {
        return each.hasUnknownBelts || (each.belt && !each.belt->isZero(0));
      })) {
    return;
  }
  const std::vector<External> known = externals;
  const auto timeOf = [&](std::size_t interval) { return samples_.times()[interval + 1]; };
  const auto spread = [&](std::size_t from, std::size_t to) {
    if (!isCrowd(timeOf(to))) {
      return;
    }
    External& external = externals[to];
    external.hasUnknownBelts = external.hasUnknownBelts || known[from].hasUnknownBelts ||
                               external.belt.value_or(*known[from].belt) != *known[from].belt;
    external.belt = known[from].belt;
  };
  for (std::size_t from = 0; from < known.size(); ++from) {
    if (!known[from].belt) {
      continue;
    }
    for (std::size_t to = from; to < known.size() && timeOf(to) - timeOf(from) <= span_; ++to) {
      spread(from, to);
    }
    for (std::size_t to = from; to-- > 0 && timeOf(from) - timeOf(to) <= span_;) {
      spread(from, to);
    }
  }
}

void Books::balance(double time, const Holdings& now, External& external) {
  give(motors_.until(time));
  give(external.rise);
  addWorkOfBelts(now, external);
  due_.momentum += external.impulse;
  due_.angularMomentum += external.angularImpulse;
  balanceMomentum(time, now, external);
  balanceAngularMomentum(time, now, external);
  balanceEnergy(time, now, external);
}

void Books::balanceMomentum(double time, const Holdings& now, const External& external) {
  Vec3 excess = now.momentum - due_.momentum;
  if (external.liesOnImmovable || external.isHeld) {
    excess.setZero();
  } else if (!external.walls.empty()) {
    excess = beyondWalls(excess, external.walls);
  }
  if (external.friction > 0) {
    excess *= 1 - std::min(1.0, external.friction / std::max(excess.norm(), external.friction));
  }
  due_.momentum = now.momentum - excess;
  report(AuditKind::kLinearMomentum, time, lasting(momentum_, time, excess.norm()), largest_.momentumScale,
         kUlps * largest_.momentumScale);
}

void Books::balanceAngularMomentum(double time, const Holdings& now, const External& external) {
  Vec3 excess = now.angularMomentum - due_.angularMomentum;
  if (external.liesOnImmovable || external.isHeld) {
    excess.setZero();
  } else if (!external.walls.empty()) {
    const Vec3 normal = external.walls.front().normal;
    const bool keepsTurn =
        std::all_of(external.walls.begin(), external.walls.end(), [&](const WallForce& wall) {
          return wall.friction == 0 && wall.normal.cross(normal).norm() < kParallel;
        });
    excess = keepsTurn ? Vec3(excess.dot(normal) * normal) : Vec3::Zero();
  }
  if (external.angularFriction > 0) {
    excess *= 1 - std::min(1.0, external.angularFriction / std::max(excess.norm(), external.angularFriction));
  }
  due_.angularMomentum = now.angularMomentum - excess;
  // Estimated velocities are as wrong as each of them is large.
  const bool isEstimated = run_.given && !(run_.given->velocities && run_.given->angularVelocities);
  const double scale = std::max({largest_.spin, (isEstimated ? 1 : kOfMembers) * largest_.angularScale,
                                 (isCrowd(time) ? kStill : kOfMotion) * largest_.momentumScale * reach_});
  report(AuditKind::kAngularMomentum, time, lasting(angularMomentum_, time, excess.norm()), scale,
         kUlps * (largest_.angularScale + largest_.turned + largest_.far * largest_.momentumScale) +
             spinWithinSteps(time));
}

void Books::balanceEnergy(double time, const Holdings& now, const External& external) {
  const double rounding = kUlps * (largest_.energyScale + largest_.far * largest_.weight);
  const bool mayFall = takesEnergy_ || external.hasUnknownBelts || external.losesInImpacts ||
                       (external.lies && group_.mayLose);
  const double excess = now.energy - due_.energy;
  report(AuditKind::kEnergyRise, time, lasting(rise_, time, std::max(excess, 0.0)), largest_.energyScale,
         rounding);
  const double highest = -fall_.with(time, -now.energy);
  if (mayFall) {
    due_.energy = std::min(due_.energy, run_.given || isCrowd(time) ? highest : now.energy);
  } else {
    report(AuditKind::kEnergyLoss, time, std::max(-excess, 0.0), largest_.energyScale, rounding);
  }
}

// [kg m²/s] By which speeds within steps may be off: a place halfway is held to the tolerance, and a
// polynomial whose acceleration there is wrong by e is off by e h²/24 in place and by at most e h/7 in speed.
// Only springs make steps so short that it counts.
double Books::spinWithinSteps(double time) const {
  double sum = 0;
  for (const std::size_t body : group_.bodies) {
    const Track& track = run_.tracks[body];
    const Motion motion = track.segments[segmentAt(track, time)].motion;
    const ContactStep* const step = std::get_if<ContactStep>(&motion);
    if (step != nullptr && !run_.given && !group_.springs.empty()) {
      sum += mass(body) * reach_ * kOfSpeed * run_.settings.tolerance / step->duration;
    }
  }
  return sum;
}

void Books::report(AuditKind kind, double time, double amount, double scale, double rounding) {
  const double least = std::numeric_limits<double>::min();
  findings_.add(kind, rounding / std::max(scale, least),
                {.size = amount / std::max(scale, least),
                 .time = time,
                 .bodies = group_.bodies,
                 .wall = {},
                 .length = length_,
                 .promised = alone_ || kind == AuditKind::kEnergyRise || !isCrowd(time)});
}

}  // namespace

void checkBalances(const Trajectory& run, const Samples& samples, const std::vector<ExchangeGroup>& groups,
                   const std::vector<double>& fallingSpeeds, Findings& findings) {
  for (const ExchangeGroup& group : groups) {
    Books(run, samples, group, fallingSpeeds, findings).check();
  }
}

}  // namespace careen
