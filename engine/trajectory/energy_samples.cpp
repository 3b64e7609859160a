#include "trajectory/energy_samples.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "physics/world/forces.h"

namespace careen {
namespace {

std::vector<std::size_t> allJoints(const World& world) {
  std::vector<std::size_t> all(world.joints.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

// Gauss–Legendre with three nodes on [0, 1]: exact for polynomials of degree 5, as those of places are.
struct WorkNode {
  double at = 0;
  double weight = 0;
};
constexpr double kRootOfThreeFifths = 0.77459666924148337704;
constexpr std::array<WorkNode, 3> kWorkNodes = {
    {{(1 - kRootOfThreeFifths) / 2, 5.0 / 18}, {0.5, 8.0 / 18}, {(1 + kRootOfThreeFifths) / 2, 5.0 / 18}}};

// [m s] ∫ x dt of a body from one time [s] to another.
Vec3 placeOverTime(const Trajectory& run, std::size_t body, double from, double to) {
  const Segments& segments = run.tracks[body].segments;
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = std::max<std::size_t>(segments.countUntil(from), 1) - 1; k < segments.countUntil(to);
       ++k) {
    const Segment segment = segments[k];
    const double begin = std::max(from, segment.start);
    const double end = k + 1 < segments.size() ? std::min(to, segments[k + 1].start) : to;
    for (const WorkNode& node : kWorkNodes) {
      const double elapsed = begin - segment.start + node.at * (end - begin);
      sum += node.weight * (end - begin) *
             stateAt(segment.motion, run.world.bodies[body].mass, elapsed).pose.position;
    }
  }
  return sum;
}

double energyOfSpring(double stiffness, double extension) { return 0.5 * stiffness * extension * extension; }

}  // namespace

EnergyShares energySharesOf(const World& world, std::span<const BodyState> states, double time) {
  EnergyShares shares;
  const Vec3 gravity = gravityAt(world, time);
  for (std::size_t body = 0; body < states.size(); ++body) {
    const MassProperties& mass = world.bodies[body].mass;
    const BodyState& state = states[body];
    if (isImmovable(mass)) {
      continue;
    }
    shares.translation += 0.5 * mass.mass * state.velocity.squaredNorm();
    shares.rotation += 0.5 * dot(angularVelocity(mass, state), state.angularMomentum);
    shares.gravity -= mass.mass * dot(gravity, state.pose.position);
  }
  for (const Spring& spring : world.springs) {
    shares.springs +=
        energyOfSpring(spring.stiffness, stretchOf(spring, world, states).length - spring.restLength);
  }
  for (const Joint& joint : world.joints) {
    if (joint.stiffness != 0 && time < joint.until) {
      shares.jointSprings +=
          energyOfSpring(joint.stiffness, jointMotionOf(joint, world, states).coordinate - joint.rest);
    }
  }
  return shares;
}

EnergySamples::EnergySamples(const Trajectory& run)
    : run_(run), motorWork_(run, allJoints(run.world), MotorWork::Drives::kNone), losses_(run) {
  std::vector<BodyState> initial;
  for (const Body& body : run.world.bodies) {
    initial.push_back(body.initial);
  }
  atStart_ = energySharesOf(run.world, initial, 0).sum();
}

// [J] By a change of gravity.
double EnergySamples::givenBy(std::size_t change) const {
  const World& world = run_.world;
  const auto& [time, gravity] = world.gravityChanges[change];
  const Vec3& before = change == 0 ? world.gravity : world.gravityChanges[change - 1].gravity;
  const std::vector<BodyState> states = run_.states(time);
  double given = 0;
  for (std::size_t body = 0; body < states.size(); ++body) {
    given -= world.bodies[body].mass.mass * dot(gravity - before, states[body].pose.position);
  }
  return given;
}

// [J] Since the last time, by gravity that slopes.
double EnergySamples::givenUntil(double time) const {
  const World& world = run_.world;
  GravityChange from{.time = world.gravitySince, .gravity = world.gravity};
  double given = 0;
  for (const GravityChange& to : world.gravityChanges) {
    const double begin = std::max(from.time, time_);
    const double end = std::min(to.time, time);
    const Vec3 slope = (to.gravity - from.gravity) / (to.time - from.time);
    for (std::size_t body = 0; begin < end && !slope.isZero(0) && body < world.bodies.size(); ++body) {
      const MassProperties& mass = world.bodies[body].mass;
      given -= isImmovable(mass) ? 0 : mass.mass * dot(slope, placeOverTime(run_, body, begin, end));
    }
    from = to;
  }
  return given;
}

RunEnergies EnergySamples::at(double time) {
  const std::vector<BodyState> states = run_.states(time);
  motors_ += motorWork_.until(time);
  if (run_.world.gravityPath == GravityPath::kLinear) {
    changes_ += givenUntil(time);
    gravities_ = run_.world.gravityChanges.size();
    time_ = time;
  }
  for (; gravities_ < run_.world.gravityChanges.size() && run_.world.gravityChanges[gravities_].time <= time;
       ++gravities_) {
    changes_ += givenBy(gravities_);
  }
  RunEnergies now{.shares = energySharesOf(run_.world, states, time),
                  .motors = motors_,
                  .changes = changes_,
                  .lost = losses_.until(time)};
  now.remaining = atStart_ + now.motors + now.changes - now.shares.sum() - now.lost.sum();
  for (std::size_t body = 0; body < states.size(); ++body) {
    const BodyState& state = states[body];
    if (isImmovable(run_.world.bodies[body].mass)) {
      continue;
    }
    const Vec3 momentum = run_.world.bodies[body].mass.mass * state.velocity;
    now.momentum += momentum;
    now.angularMomentum += state.angularMomentum + state.pose.position.cross(momentum);
  }
  return now;
}

}  // namespace careen
