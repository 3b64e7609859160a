#include "physics/pile/crowd_bounce.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "physics/impact/impact_law.h"
#include "physics/pile/crowd.h"
#include "support/crates.h"
#include "support/crowd_stages.h"
#include "support/pile_scenes.h"

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

// In steps so short that nothing turns in them it is the law of exact impacts, with friction: a box that
// strikes with one corner, at any attitude and spin.
TEST(CrowdBounces, cornerStrikesAsInAnExactImpactWhereStepsAreShort) {
  Pourer pourer(3);
  int struckCount = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Material material{.restitution = 0.6, .friction = trial % 2 == 0 ? 0.1 : 0.5};
    World world = floorWorld(material);
    world.gravity = Vec3::Zero();
    Body body = crate("a", Vec3(0.1, 0.07, 0.05), Vec3::Zero(), material);
    const Mat3 attitude = pourer.attitude().toRotationMatrix();
    std::vector<Vec3> corners;
    for (int k = 0; k < kCorners; ++k) {
      corners.push_back(attitude * corner(body, k));
    }
    std::sort(corners.begin(), corners.end(), [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
    const Vec3 lowest = corners[0];
    if (corners[1].z() - lowest.z() < 2 * kTogether * Crowd::kUsualTolerance) {
      continue;  // two corners would strike together
    }
    body.initial = {.pose = {.position = Vec3(0, 0, 1e-10 - lowest.z()), .worldFromBody = attitude},
                    .velocity = pourer.vector(-1, 1) - Vec3(0, 0, 3)};
    body.initial.angularMomentum = angularMomentum(body.mass, attitude, pourer.vector(-5, 5));
    world.bodies.push_back(body);
    CrowdStages stages(world);
    stages.take(1e-9);

    BodyState exact = body.initial;
    const MassProperties floor = immovable();
    BodyState still;
    const std::vector<ImpactBody> bodies{{.mass = &body.mass, .state = &exact},
                                         {.mass = &floor, .state = &still}};
    const std::vector<ImpactContact> contacts{
        {.a = 0, .b = 1, .armA = lowest, .normal = Vec3::UnitZ(), .material = material}};
    std::vector<ImpactShare> shares(1);
    resolveImpact(bodies, contacts, shares);
    const PileBody& after = stages.members[stages.of(0)];
    EXPECT_LT((after.velocity - exact.velocity).norm(), 2.5e-3) << trial;  // measured 1.9e-3
    EXPECT_LT(0.1 * (after.omega - angularVelocity(body.mass, exact)).norm(), 7e-3)
        << trial;  // measured 5.4e-3
    struckCount += shares[0].impulse > 0 ? 1 : 0;
  }
  EXPECT_GT(struckCount, 150);
}

}  // namespace
}  // namespace careen
