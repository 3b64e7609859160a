#include "physics/pile/crowd_bounce.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/crates.h"
#include "support/crowd_stages.h"

namespace careen {
namespace {

using namespace test;

World flatFall(double restitution, double gap, double speed) {
  World world = floorWorld({.restitution = restitution});
  world.gravity = Vec3::Zero();
  world.bodies.push_back(
      crate("a", Vec3::Constant(0.25), Vec3(0, 0, 0.25 + gap), {.restitution = restitution}));
  world.bodies[0].initial.velocity = Vec3(0, 0, -speed);
  return world;
}

// Down by the gap, then up with e v; both solves' impulses together are m v (1 + e).
TEST(CrowdBounces, crateThatFallsFlatLeavesWithItsPartOfTheSpeed) {
  const double speed = 10;
  for (const double restitution : {0.0, 0.5, 1.0}) {
    const World world = flatFall(restitution, 0.01, speed);
    CrowdStages stages(world);
    stages.take(test::kCrowdStep);
    EXPECT_NEAR(stages.members[stages.of(0)].position.z(), 0.25, 1e-6);
    const double up = restitution > 0 ? restitution * speed : -0.01 / test::kCrowdStep;
    EXPECT_NEAR(stages.members[stages.of(0)].velocity.z(), up, 1e-5 * speed) << restitution;
    ASSERT_EQ(stages.bounces.impacts().size(), 4U);
    double impulse = 0;
    for (const CrowdBounces::Struck& struck : stages.bounces.impacts()) {
      impulse += struck.impulse;
      EXPECT_NEAR(struck.approach, speed, 1e-12);
      EXPECT_EQ(struck.normal, Vec3(0, 0, 1));
      EXPECT_EQ(struck.b, 0);  // the floor
    }
    EXPECT_NEAR(impulse, 125 * (speed + up), 1e-3 * speed) << restitution;
    stages.bounces.clear();
    EXPECT_TRUE(stages.bounces.impacts().empty());
  }
}

TEST(CrowdBounces, nothingBouncesThatDoesNotMeet) {
  const World world = flatFall(1, 0.01, 0.5);
  CrowdStages stages(world);
  stages.take(test::kCrowdStep);
  EXPECT_TRUE(stages.bounces.impacts().empty());
  EXPECT_EQ(stages.members[stages.of(0)].velocity, Vec3(0, 0, -0.5));
}

}  // namespace
}  // namespace careen
