#include "trajectory/force_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <variant>
#include <vector>

#include "physics/world/forces.h"
#include "support/jointed.h"
#include "trajectory/impact_moment.h"

namespace careen {
namespace {

constexpr double kPullOfForces = 10;  // [m/s²]

World onFloor(double friction) {
  World world;
  world.gravity = Vec3(0, 0, -kPullOfForces);
  world.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
  world.walls[0].material.friction = friction;
  return world;
}

Body rough(Body body, double friction) {
  body.material.friction = friction;
  body.material.restitution = 0;
  return body;
}

struct Sum {
  Vec3 force = Vec3::Zero();
  std::size_t rows = 0;
  double left = 0;
};
// On the first box.
Sum sumOf(const std::vector<ContactPush>& pushes) {
  Sum sum;
  for (const ContactPush& push : pushes) {
    if (push.a.value == 0 || (push.b && push.b->isBody(0))) {
      sum.force += (push.a.value == 0 ? 1 : -1) * push.force;
      ++sum.rows;
    }
    sum.left = std::max(sum.left, push.left);
  }
  return sum;
}

// 2 kg at 3 m/s and μ = ½ on the floor: braked by 10 N for 0.6 s, then at rest by its weight's opposite
// alone.
TEST(ForceSamples, ofABoxThatSlidesAndStops) {
  World world = onFloor(0.5);
  world.bodies = {rough(box("box", Vec3(0.5, 0.5, 0.1), 2, Vec3(0, 0, 0.1), Vec3(3, 0, 0)), 0.5)};
  const Trajectory run = record(world, {.duration = 1}, "");
  const ForceSamples samples(run);
  for (const double time : {0.0, 0.25, 0.59}) {
    const Sum sum = sumOf(samples.at(time));
    EXPECT_EQ(sum.rows, 4U);
    EXPECT_LT((sum.force - Vec3(-10, 0, 20)).norm(), 1e-9) << time;
    EXPECT_LT(sum.left, 1e-9);
  }
  for (const double time : {0.61, 1.0}) {
    const Sum sum = sumOf(samples.at(time));
    EXPECT_EQ(sum.rows, 4U);
    EXPECT_LT((sum.force - Vec3(0, 0, 20)).norm(), 1e-12) << time;
    EXPECT_LT(sum.left, 1e-12);
  }
  EXPECT_THROW(samples.at(1.5), InputError);
}

// Put on a belt of 2 m/s with μ = ½: 10 N along it for 0.4 s; then nothing but its weight.
TEST(ForceSamples, ofABoxOnABelt) {
  World world = onFloor(0.5);
  world.walls[0].material.surface.velocity = Vec3(2, 0, 0);
  world.bodies = {rough(box("box", Vec3(0.5, 0.5, 0.1), 2, Vec3(0, 0, 0.1)), 0.5)};
  const Trajectory run = record(world, {.duration = 1}, "");
  const ForceSamples samples(run);
  EXPECT_LT((sumOf(samples.at(0.2)).force - Vec3(10, 0, 20)).norm(), 1e-6);  // measured: 1e-7
  EXPECT_LT((sumOf(samples.at(0.8)).force - Vec3(0, 0, 20)).norm(), 1e-9);
}

// In flight nothing pushes, after it has landed its weight does.
TEST(ForceSamples, areNoneInFlight) {
  World world = onFloor(0.5);
  world.bodies = {rough(box("box", Vec3::Constant(0.5), 2, Vec3(0, 0, 1.5)), 0.5)};
  const Trajectory run = record(world, {.duration = 1}, "");
  const ForceSamples samples(run);
  EXPECT_TRUE(samples.at(0.3).empty());
  EXPECT_LT((sumOf(samples.at(0.5)).force - Vec3(0, 0, 20)).norm(), 1e-12);
}

// Held by a spring at its rest length less 0.1 m: 5 N of its weight of 20 N.
TEST(ForceSamples, leaveToSpringsDragAndGravityWhatIsTheirs) {
  World world = onFloor(0.5);
  world.bodies = {rough(box("box", Vec3::Constant(0.5), 2, Vec3(0, 0, 0.5)), 0.5)};
  world.springs = {{.from = {.body = 0, .point = Vec3(0, 0, 0.5)},
                    .to = {.body = {}, .point = Vec3(0, 0, 3)},
                    .stiffness = 50,
                    .restLength = 1.9}};
  world.gravityChanges = {{.time = 0.5, .gravity = Vec3(0, 0, -2 * kPullOfForces)}};
  const Trajectory run = record(world, {.duration = 1}, "");
  const ForceSamples samples(run);
  EXPECT_LT((sumOf(samples.at(0.2)).force - Vec3(0, 0, 15)).norm(), 1e-9);
  EXPECT_LT((sumOf(samples.at(0.7)).force - Vec3(0, 0, 35)).norm(), 1e-9);
}

// A floor carries what gravity pulls at each moment: from 20 N to 60 N in 1 s, and 60 N from then on.
TEST(ForceSamples, carryGravityThatSlopes) {
  World world = onFloor(0.5);
  world.bodies = {rough(box("box", Vec3::Constant(0.5), 2, Vec3(0, 0, 0.5)), 0.5)};
  world.gravityChanges = {{.time = 1, .gravity = Vec3(0, 0, -3 * kPullOfForces)}};
  world.gravityPath = GravityPath::kLinear;
  const Trajectory run = record(world, {.duration = 1.5}, "");
  const ForceSamples samples(run);
  for (const double time : {0.2, 0.5, 0.9, 1.2}) {
    const double due = 2 * kPullOfForces * (1 + 2 * std::min(time, 1.0));
    EXPECT_LT((sumOf(samples.at(time)).force - Vec3(0, 0, due)).norm(), 1e-7) << time;
  }
}

/// Gauss–Legendre with five nodes, exact for the velocities of steps.
constexpr std::array<std::array<double, 2>, 5> kNodes = {{{0.04691007703066800, 0.11846344252809454},
                                                          {0.23076534494715845, 0.23931433524968324},
                                                          {0.5, 0.28444444444444444},
                                                          {0.76923465505284155, 0.23931433524968324},
                                                          {0.95308992296933200, 0.11846344252809454}}};

/// [s] In steps so short velocities are rounding.
constexpr double kUnseen = 1e-12;

/// What forces do not give, and what of the momentum that passed that is.
struct Balance {
  double off = 0;     // [N s] linear, the largest of a body from impact to impact
  double passed = 0;  // [N s]
  double left = 0;    // [N]
};

// Between all moments at which a motion of any body begins, of each body: M Δv − ∫(F + weight) dt; there are
// no impacts in between. Also of its angular momentum, over the radius.
Balance balanceOf(const Trajectory& run) {
  std::set<double> moments{0, run.settings.duration};
  for (const Track& track : run.tracks) {
    for (const Segment& segment : track.segments) {
      if (segment.start < run.settings.duration) {
        moments.insert(segment.start);
      }
    }
  }
  const ForceSamples samples(run);
  Balance balance;
  for (auto next = std::next(moments.begin()); next != moments.end(); ++next) {
    const double from = *std::prev(next);
    const double length = *next - from;
    if (length < kUnseen) {
      continue;
    }
    std::vector<BodyState> states = run.states(from);
    std::vector<Vec3> linear(states.size(), Vec3::Zero());
    std::vector<Vec3> angular(states.size(), Vec3::Zero());
    for (const auto& [place, weight] : kNodes) {
      const double time = from + place * length;
      const double seconds = weight * length;
      const std::vector<BodyState> now = run.states(time);
      for (std::size_t body = 0; body < states.size(); ++body) {
        linear[body] += seconds * run.world.bodies[body].mass.mass * run.world.gravity;
      }
      for (const ContactPush& push : samples.at(time)) {
        const auto give = [&](int body, double sign) {
          const auto b = static_cast<std::size_t>(body);
          linear[b] += sign * seconds * push.force;
          angular[b] += sign * seconds * (push.point - now[b].pose.position).cross(push.force);
        };
        give(push.a.value, 1);
        if (push.b && !push.b->isWall()) {
          give(push.b->body(), -1);
        }
        balance.left = std::max(balance.left, push.left);
      }
    }
    for (std::size_t body = 0; body < states.size(); ++body) {
      const Body& moved = run.world.bodies[body];
      const Segments& segments = run.tracks[body].segments;
      const Segment segment = segments[segments.countUntil(from) - 1];
      const BodyState end = stateAt(segment.motion, moved.mass, *next - segment.start);
      const double off =
          (moved.mass.mass * (end.velocity - states[body].velocity) - linear[body]).norm() +
          (end.angularMomentum - states[body].angularMomentum - angular[body]).norm() / radiusOf(moved);
      balance.off = std::max(balance.off, off);
      balance.passed += length * moved.mass.mass * run.world.gravity.norm();
    }
  }
  return balance;
}

// Boxes thrown onto each other: from impact to impact forces and weight give all momentum that boxes gain.
TEST(ForceSamples, andWeightAreTheChangeOfMomentum) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  double worst = 0;
  for (int trial = 0; trial < 8; ++trial) {
    World world = onFloor(0.6);
    for (int k = 0; k < 3; ++k) {
      Body each =
          rough(box("box", Vec3(0.3, 0.2 + 0.05 * k, 0.15), 1 + k, Vec3(0.1 * any(random), 0, 0.4 + 0.7 * k),
                    Vec3(any(random), any(random), 0), 3 * Vec3(any(random), any(random), any(random))),
                0.5);
      world.bodies.push_back(each);
    }
    const Trajectory run =
        record(world, {.duration = 1.5, .crowds = {.when = CrowdSettings::When::kNever}}, "");
    const Balance balance = balanceOf(run);
    worst = std::max(worst, balance.off / balance.passed);
  }
  EXPECT_LT(worst, 1e-5);  // measured: 2e-6 of what weight gave in the run
}

// In a crowd forces are means: while it lies they are what it weighs, and over the whole run they give what
// weight gave, and stopped its fall.
TEST(ForceSamples, ofACrowdAreMeansWithItsImpacts) {
  World world = onFloor(0.5);
  double mass = 0;
  for (int k = 0; k < 8; ++k) {
    world.bodies.push_back(rough(
        box("box", Vec3::Constant(0.1), 1 + 0.25 * k, Vec3(0.02 * (k % 3), 0.03 * (k % 2), 0.15 + 0.25 * k)),
        0.5));
    mass += 1 + 0.25 * k;
  }
  const RunSettings settings{.duration = 3, .crowds = {.when = CrowdSettings::When::kAbove, .above = 1}};
  const Trajectory run = record(world, settings, "");
  ASSERT_TRUE(run.figures.boundedFrom.has_value());
  const ForceSamples samples(run);
  Vec3 given = Vec3::Zero();
  Vec3 onFloorAtEnd = Vec3::Zero();
  constexpr int kTimes = 3000;
  for (int k = 0; k < kTimes; ++k) {
    onFloorAtEnd.setZero();
    for (const ContactPush& push : samples.at((k + 0.5) * 3 / kTimes)) {
      onFloorAtEnd += push.b && push.b->isWall() ? push.force : Vec3::Zero();
    }
    given += 3.0 / kTimes * onFloorAtEnd;
  }
  Vec3 struck = Vec3::Zero();  // before there was a crowd
  for (const Impact& impact : run.impacts) {
    if (impact.b.isWall() && impact.time <= *run.figures.boundedFrom) {
      struck += impact.impulse * impact.normal;
    }
  }
  EXPECT_LT((onFloorAtEnd - Vec3(0, 0, mass * kPullOfForces)).norm(), 1e-6 * mass * kPullOfForces);
  // Measured: 2e-4.
  EXPECT_NEAR(given.z() + struck.z(), 3 * mass * kPullOfForces, 1e-3 * 3 * mass * kPullOfForces);
}

TEST(ForceSamples, haveNamesOfWhatPushes) {
  World world = onFloor(0.5);
  world.bodies = {rough(box("box", Vec3::Constant(0.5), 2, Vec3(0, 0, 0.5)), 0.5)};
  const Trajectory run = record(world, {.duration = 1}, "");
  const std::vector<ContactPush> pushes = ForceSamples(run).at(0.5);
  ASSERT_EQ(pushes.size(), 4U);
  EXPECT_EQ(partnerName(run, pushes[0]), "floor");
  EXPECT_EQ(partnerName(run, {}), "");
}

}  // namespace
}  // namespace careen
