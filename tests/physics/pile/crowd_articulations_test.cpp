// Joints among the members of a crowd: against closed forms, with what was measured beside each bound.

#include "physics/pile/crowd_articulations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "support/crowd_run.h"
#include "support/crowd_scenes.h"
#include "support/jointed.h"

namespace careen {
namespace {

using namespace test;
using Kind = Joint::Kind;

constexpr double kOnEarth = 9.81;

World hanging() {
  World world;
  world.gravity = Vec3(0, 0, -kOnEarth);
  return world;
}

// Links of 0.2 m that lie along x from the origin, the first on the world; the last one of that mass [kg].
World chainOf(int count, double last, Kind kind = Kind::kBall) {
  World world = hanging();
  for (int k = 0; k < count; ++k) {
    world.bodies.push_back(box("link-" + std::to_string(k), Vec3(0.1, 0.02, 0.02), k == count - 1 ? last : 1,
                               Vec3(0.1 + 0.2 * k, 0, 0)));
  }
  for (int k = 0; k < count; ++k) {
    join(world, kind, k, k == 0 ? std::nullopt : std::optional(k - 1), Vec3(0.2 * k, 0, 0), Vec3::UnitY());
  }
  return world;
}

// 2 rad from hanging: 8.9e-4 m off after 5 s, the joint open by 4.5e-5 m between its steps.
TEST(CrowdArticulations, aBarOnAHingeIsAPendulum) {
  World world = hanging();
  world.bodies = {bar("bar", 2)};
  join(world, Kind::kHinge, 0, {}, Vec3::Zero(), Vec3::UnitY());
  const Recorded run = crowdRun(world, 5);
  const double angle = pendulumAfter(5, 2, 0, squaredFrequencyOf(world.bodies[0], kOnEarth))[0];
  const Vec3 truth(-0.5 * std::sin(angle), 0, -0.5 * std::cos(angle));
  EXPECT_LE((run.last(world, 0, 5).pose.position - truth).norm(), 3e-3);
  EXPECT_LE(largestGapIn(world, run, 5), 0.2 * kTolerance);
}

// At the end of each step all is closed, in a loop with redundant rows, too.
TEST(CrowdArticulations, jointsAreClosedAfterEachStep) {
  const World world = parallelogram(0.9, hanging().gravity);
  Crowd crowd(world, kTolerance);
  for (std::size_t k = 0; k < world.bodies.size(); ++k) {
    const BodyState& state = world.bodies[k].initial;
    crowd.admit(k, state, Quat(state.pose.worldFromBody));
  }
  crowd.articulations().list(0);
  for (int step = 0; step < 400; ++step) {
    crowd.step(1);
    for (const Joint& joint : world.joints) {
      const Pose from = crowd.state(at(*joint.from.body)).pose;
      const Pose to = joint.to.body ? crowd.state(at(*joint.to.body)).pose : Pose{};
      EXPECT_LE((joint.from.pointAt(from) - joint.to.pointAt(to)).norm(), 0x1p-12 * kTolerance);
    }
  }
}

// Open by 1.9e-5 and 5.8e-6 m at moments between steps.
TEST(CrowdArticulations, aHeavyEndDoesNotOpenAChain) {
  for (const double last : {1.0, 100.0}) {
    const World world = chainOf(10, last);
    const Recorded run = crowdRun(world, 1);
    EXPECT_LE(largestGapIn(world, run, 1), kTolerance) << last;
  }
}

// Which nothing touches: both momenta, and the energy of a motion without gravity.
TEST(CrowdArticulations, aFreeChainKeepsItsMomenta) {
  World world = chainOf(6, 3);
  world.joints.erase(world.joints.begin());
  world.gravity.setZero();
  for (std::size_t k = 0; k < world.bodies.size(); ++k) {
    world.bodies[k].initial.velocity = Vec3(0, 0.4 * std::sin(2.0 * static_cast<double>(k)), 0.3);
  }
  CrowdRun run(world);
  const auto sums = [&] {
    Vec3 momentum = Vec3::Zero();
    Vec3 angular = Vec3::Zero();
    const std::vector<BodyState> states = run.statesAtVelocities();
    for (std::size_t k = 0; k < states.size(); ++k) {
      const double mass = world.bodies[k].mass.mass;
      momentum += mass * states[k].velocity;
      angular += mass * states[k].pose.position.cross(states[k].velocity) + states[k].angularMomentum;
    }
    return std::pair(momentum, angular);
  };
  run.crowd().articulations().list(0);
  const auto before = sums();
  for (int frame = 0; frame < 60; ++frame) {
    run.step();
  }
  const auto after = sums();
  EXPECT_LE((after.first - before.first).norm(), 1e-13);   // 3.5e-16
  EXPECT_LE((after.second - before.second).norm(), 2e-5);  // 3.5e-6: joints are closed where bodies move
}

// Let go 0.4 m below where a rope of 1 m ends: it falls 0.6 m, and swings; longer by 4.0e-5 m between steps.
TEST(CrowdArticulations, aRopeEndsAtItsLength) {
  World world = hanging();
  world.bodies = {box("box", Vec3(0.1, 0.1, 0.1), 2, Vec3(0.3, 0, -0.4))};
  tie(world, Kind::kRope, 0, Vec3(0, 0, 0.1), Vec3::Zero(), 1);
  const Recorded run = crowdRun(world, 3);
  EXPECT_LE(largestGapIn(world, run, 3), kTolerance);
  EXPECT_LT(run.at(world, 0, 0.6).pose.position.z(), -0.9);
}

// A bar falls onto its limit, 1 rad from hanging, and stays there.
TEST(CrowdArticulations, aLimitStops) {
  World world = hanging();
  world.bodies = {bar("bar", 1.5)};
  Joint& hinge = join(world, Kind::kHinge, 0, {}, Vec3::Zero(), Vec3::UnitY());
  hinge.lowest = -0.5;
  const Recorded run = crowdRun(world, 2);
  double least = 0;
  for (int k = 0; k <= 997; ++k) {
    const BodyState at = run.at(world, 0, 2.0 * k / 997);
    least = std::min(least, jointCoordinate(world.joints[0], at.pose, Pose{}));
  }
  EXPECT_NEAR(least, -0.5, 1e-8);  // 1.0e-9
  EXPECT_NEAR(jointCoordinate(world.joints[0], run.last(world, 0, 2).pose, Pose{}), -0.5, 1e-9);
}

// A pendulum lets go at a moment that no step would end at, beside itself as no crowd: 4.1e-4 m apart after 1
// s. Without what its joint gave in the last half of a step, it was 2.6e-2 m.
TEST(CrowdArticulations, whatLetsGoFliesFromThen) {
  World world = hanging();
  world.bodies = {bar("bar", 1)};
  join(world, Kind::kBall, 0, {}, Vec3::Zero()).until = 0.4371;
  const Vec3 exact = runFor(world, 1).last(world, 0, 1).pose.position;
  EXPECT_LE((crowdRun(world, 1).last(world, 0, 1).pose.position - exact).norm(), 1e-3);
}

// τ t²/2I of a wheel; nothing is pushed that is at rest without it.
TEST(CrowdArticulations, aMotorTurnsAWheel) {
  World world;
  world.bodies = {box("wheel", Vec3(0.2, 0.2, 0.05), 3, Vec3::Zero())};
  join(world, Kind::kHinge, 0, {}, Vec3::Zero());
  world.control = Control{
      .period = 0.05, .motors = {{.joint = 0, .largest = 0.1, .target = {.offset = 1e6}, .stiffness = 1}}};
  const Recorded run = crowdRun(world, 1);
  const double angle = 0.5 * 0.1 / world.bodies[0].mass.inertiaBody[2];
  const Mat3 turned = run.last(world, 0, 1).pose.worldFromBody;
  EXPECT_NEAR(std::atan2(turned(1, 0), turned(0, 0)), angle, 1e-11);  // 2.8e-13
  EXPECT_NEAR(angularVelocity(world.bodies[0].mass, run.last(world, 0, 1)).z(), 2 * angle,
              5e-3);  // 3.5e-3: the mean of the last step
}

// A wheel with I ω₀ = 2 N m s that 0.5 N m of friction stop after 4 s and 2 ω₀; and one that 0.5 N m drive up
// to ω₀ in that time, which is kept.
// Right but for half a step: 8.3e-3 rad.
TEST(CrowdArticulations, frictionStopsAndADriveKeepsItsSpeed) {
  for (const double kept : {0.0, 3.0}) {
    World world;
    world.bodies = {box("wheel", Vec3(0.5, 0.5, 0.1), 4, Vec3::Zero())};
    const double inertia = world.bodies[0].mass.inertiaBody[2];
    Joint& hinge = join(world, Kind::kHinge, 0, {}, Vec3::Zero());
    hinge.grip = inertia * 3 / 4;
    hinge.keptRate = kept;
    world.bodies[0].initial.angularMomentum = Vec3(0, 0, kept == 0 ? 3 * inertia : 0);
    const Recorded run = crowdRun(world, 5);
    const Mat3 turned = run.last(world, 0, 5).pose.worldFromBody;
    const double angle = 6 + kept;
    EXPECT_NEAR(std::remainder(std::atan2(turned(1, 0), turned(0, 0)) - angle, 2 * std::numbers::pi), 0,
                1e-2);
    EXPECT_NEAR(angularVelocity(world.bodies[0].mass, run.last(world, 0, 5)).z(), kept, 1e-9);
  }
}

// A box on the floor, and an arm in the air that it holds.
TEST(CrowdArticulations, jointedMembersSleepTogether) {
  World world = onARoughFloor(0.5);
  world.bodies = {ofMaterial(box("base", Vec3(0.2, 0.2, 0.2), 3, Vec3(0, 0, 0.25)), 0.5),
                  box("arm", Vec3(0.2, 0.05, 0.05), 1, Vec3(0.4, 0, 0.3))};
  join(world, Kind::kFixed, 1, 0, Vec3(0.2, 0, 0.3));
  CrowdRun run(world);
  for (int frame = 0; frame < 300 && !run.atRest(); ++frame) {
    run.crowd().articulations().list(0);
    run.step();
  }
  EXPECT_TRUE(run.atRest());
  EXPECT_NEAR(run.states()[1].pose.position.z(), 0.25, 1e-6);  // 4.1e-8
}

// A box that slides without friction strikes the base after 1 s, when both have slept for long.
TEST(CrowdArticulations, jointedMembersWakeTogether) {
  World world = onARoughFloor(0.5);
  world.bodies = {ofMaterial(box("base", Vec3(0.2, 0.2, 0.2), 3, Vec3(0, 0, 0.2)), 0.5),
                  box("arm", Vec3(0.2, 0.05, 0.05), 1, Vec3(0.4, 0, 0.3)),
                  ofMaterial(box("hammer", Vec3(0.2, 0.2, 0.2), 6, Vec3(-3.5, 0, 0.2), Vec3(3, 0, 0)), 0)};
  join(world, Kind::kFixed, 1, 0, Vec3(0.2, 0, 0.3));
  CrowdRun run(world);
  for (int frame = 0; frame < 90; ++frame) {
    run.crowd().articulations().list(0);
    run.step();
    if (frame == 57) {
      EXPECT_TRUE(run.sleeps(0) && run.sleeps(1));
    }
  }
  const BodyState& base = run.states()[0];
  EXPECT_GT(base.pose.position.x(), 0.1);
  EXPECT_LE(
      (world.joints[0].from.pointAt(run.states()[1].pose) - world.joints[0].to.pointAt(base.pose)).norm(),
      0x1p-12 * kTolerance);
}

// As named pairs do, and joined ones unless asked.
TEST(CrowdArticulations, boxesThatPassThroughEachOtherDoNotMeet) {
  World world = hanging();
  world.bodies = {box("low", Vec3(0.1, 0.1, 0.1), 1, Vec3::Zero()),
                  box("high", Vec3(0.1, 0.1, 0.1), 1, Vec3(0, 0, 1))};
  world.bodies[0].initial.velocity = Vec3(0, 0, 3);
  world.apart = {{0, 1}};
  join(world, Kind::kRope, 0, 1, Vec3::Zero()).length = 10;
  const Recorded run = crowdRun(world, 1);
  EXPECT_NEAR(run.last(world, 0, 1).pose.position.z(), 3 - kOnEarth / 2, 1e-12);  // 8e-14
  EXPECT_TRUE(run.impacts.empty());
}

}  // namespace
}  // namespace careen
