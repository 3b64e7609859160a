#include "physics/pile/crowd_impulses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/crates.h"
#include "support/crowd_stages.h"

namespace careen {
namespace {

using namespace test;

constexpr double kMass = 125;

// A crate that falls flat on the floor, without gravity. It has place 1, after the floor.
World fallingCrate(double gap, double speed) {
  World world = floorWorld({});
  world.gravity = Vec3::Zero();
  world.bodies.push_back(crate("a", Vec3::Constant(0.25), Vec3(0, 0, 0.25 + gap), {}));
  world.bodies[0].initial.velocity = Vec3(0, 0, -speed);
  return world;
}

double impulseOn(const PileManifold& manifold) {
  double sum = 0;
  for (int k = 0; k < manifold.count; ++k) {
    sum += manifold.points[at(k)].normalImpulse;
  }
  return sum;
}

// It may come down by the gap, and no farther: v = −gap/h. The impulse is that of the change.
TEST(CrowdImpulses, closeTheGapAndNoMore) {
  const double gap = 0.01;
  const double speed = 10;
  const World world = fallingCrate(gap, speed);
  CrowdStages stages(world);
  stages.meet(test::kCrowdStep);
  stages.impulses.find();
  stages.impulses.keep();
  EXPECT_EQ(stages.impulses.rows(), 4);
  EXPECT_NEAR(stages.impulses.solver().velocity(1).z(), -gap / test::kCrowdStep, 1e-6 * speed);
  EXPECT_NEAR(impulseOn(stages.manifold()), kMass * (speed - gap / test::kCrowdStep), 1e-6 * kMass * speed);
  EXPECT_NEAR(stages.impulses.kineticBefore(1), 0.5 * kMass * speed * speed, 1e-9);
  EXPECT_NEAR(stages.impulses.kineticEnergy(1), 0.5 * kMass * std::pow(gap / test::kCrowdStep, 2), 1e-2);
}

// Within three tolerances of the floor it stops where it is: so all its corners strike in one step.
TEST(CrowdImpulses, nearlyClosedGapIsOneThatStruck) {
  const World world = fallingCrate(2 * CrowdMembers::kUsualTolerance, 10);
  CrowdStages stages(world);
  stages.meet(test::kCrowdStep);
  stages.impulses.find();
  EXPECT_NEAR(stages.impulses.solver().velocity(1).z(), 0, 1e-5);
}

TEST(CrowdImpulses, areNoneWhereTheGapStaysOpen) {
  const World world = fallingCrate(0.01, 0.5);  // 2.8 mm in the step
  CrowdStages stages(world);
  stages.meet(test::kCrowdStep);
  stages.impulses.find();
  EXPECT_EQ(stages.impulses.solver().velocity(1).z(), -0.5);
  EXPECT_FALSE(stages.impulses.solver().pushed(1));
}

// From 0.9 of the tolerance to half of it.
TEST(CrowdImpulses, shiftUndoesPenetrationButForWhatKeepsTheContact) {
  const double tolerance = CrowdMembers::kUsualTolerance;
  const World world = fallingCrate(-0.9 * tolerance, 0);
  CrowdStages stages(world);
  stages.meet(test::kCrowdStep);
  stages.impulses.find();
  stages.impulses.shift(stages.apart.projection());
  ASSERT_TRUE(stages.impulses.isShifted(1));
  EXPECT_NEAR(stages.impulses.solver().displacement(1).z(), 0.4 * tolerance, 0.05 * tolerance);  // 0.42
  EXPECT_NEAR(stages.impulses.shiftOf(1), 0.4 * tolerance, 0.1 * tolerance);  // 0.46: it turns a little
  stages.impulses.dontShift();
  EXPECT_EQ(stages.impulses.shiftOf(1), 0);
}

// More than 2⁻¹³ of the kinetic energy.
TEST(CrowdImpulses, tellThatTheStepGainedEnergy) {
  const World world = fallingCrate(1, 2);
  CrowdStages stages(world);
  stages.take(test::kCrowdStep);
  EXPECT_FALSE(stages.impulses.gainedEnergy());
  stages.members.ways[stages.of(0)].kinetic *= 1 + 0x1p-14;
  EXPECT_FALSE(stages.impulses.gainedEnergy());
  stages.members.ways[stages.of(0)].kinetic *= 1 + 0x1p-13;
  EXPECT_TRUE(stages.impulses.gainedEnergy());
}

}  // namespace
}  // namespace careen
