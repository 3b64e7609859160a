#include "physics/pile/crowd_apart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/crates.h"
#include "support/crowd_stages.h"

namespace careen {
namespace {

using namespace test;

constexpr double kApartTolerance = CrowdMembers::kUsualTolerance;

// Two crates, one of half the mass, that deep in each other.
World overlapping(double depth) {
  World world;
  world.bodies.push_back(crate("a", Vec3::Constant(0.25), Vec3(0, 0, 0), {}, 1000));
  world.bodies.push_back(crate("b", Vec3::Constant(0.25), Vec3(0.5 - depth, 0, 0), {}, 500));
  return world;
}

// As in a step that began apart.
void goInto(CrowdStages& stages) {
  stages.members.begin();
  stages.members.start[1].position.x() = 0.5;
  stages.meet(1.0 / 180);
  ASSERT_EQ(stages.contacts.near().size(), 1U);
  ASSERT_NE(stages.depth.find(), 0);
}

// The lighter one goes twice as far: the centre of both stays.
TEST(CrowdApart, mendsByMass) {
  const double depth = 2 * kApartTolerance;
  const World world = overlapping(depth);
  CrowdStages stages(world);
  goInto(stages);
  EXPECT_TRUE(stages.apart.mend());
  const double a = stages.members[0].position.x();
  const double b = stages.members[1].position.x() - (0.5 - depth);
  EXPECT_GT(b - a, depth - 1.45 * kApartTolerance);
  EXPECT_LT(b - a, depth);
  EXPECT_NEAR(b, -2 * a, 1e-9);
  EXPECT_NEAR(stages.apart.left(), depth - (b - a),
              0.02 * kApartTolerance);  // corner by corner: they turn a little
  EXPECT_TRUE(stages.members.ways[0].projected && stages.members.ways[1].pushed);
  EXPECT_EQ(stages.members[0].velocity, Vec3(0, 0, 0));
  EXPECT_GT(stages.apart.passes(), 0);
  stages.apart.begin();
  EXPECT_EQ(stages.apart.left(), 0);
}

// After failures it waits, and twice as long and one after the next.
TEST(CrowdApart, mendingWaitsAfterFailures) {
  const World world = overlapping(2 * kApartTolerance);
  CrowdStages stages(world);
  goInto(stages);
  stages.memory.mendingWait = 2;
  stages.memory.mendingPause = 7;
  EXPECT_FALSE(stages.apart.mend());
  EXPECT_FALSE(stages.apart.mend());
  EXPECT_EQ(stages.memory.mendingWait, 0);
  EXPECT_EQ(stages.apart.passes(), 0);
  EXPECT_TRUE(stages.apart.mend());
  EXPECT_EQ(stages.memory.mendingPause, 0);
}

// Every three longest steps.
TEST(CrowdApart, allAreProjectedEveryFewSteps) {
  const World world = overlapping(2 * kApartTolerance);
  CrowdStages stages(world);
  stages.members.begin();
  stages.meet(stages.members.longestStep());
  EXPECT_FALSE(stages.apart.projectAll());
  EXPECT_FALSE(stages.apart.projectAll());
  EXPECT_NEAR(stages.depth.overlap(stages.contacts.pairs()[0]), 2 * kApartTolerance, 1e-12);
  EXPECT_TRUE(stages.apart.projectAll());
  EXPECT_LT(stages.depth.overlap(stages.contacts.pairs()[0]), 1.45 * kApartTolerance);
  EXPECT_EQ(stages.memory.sinceProjection, 0);
}

// Pushed apart it lies at the other's side; what is left is what it says.
TEST(CrowdApart, projectsOnTheWayAsFarAsItCan) {
  const World world = overlapping(8 * kApartTolerance);
  CrowdStages stages(world);
  goInto(stages);
  const double left = stages.apart.projectOnWay();
  EXPECT_LE(left, 1.45 * kApartTolerance);
  EXPECT_NEAR(stages.depth.overlap(stages.contacts.pairs()[0]), std::max(0.0, left), kApartTolerance);
}

}  // namespace
}  // namespace careen
