#include "physics/pile/crowd_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/crates.h"
#include "support/crowd_stages.h"

namespace careen {
namespace {

using namespace test;

// x + v h + g h²/2, and v + g h at its end.
TEST(CrowdMotion, crateThatNothingTouchesFollowsItsParabola) {
  World world = floorWorld({});
  world.bodies.push_back(crate("a", Vec3::Constant(0.25), Vec3(0, 0, 5), {}));
  const Vec3 velocity(3, 1, 4);
  world.bodies[0].initial.velocity = velocity;
  CrowdStages stages(world);
  stages.take(test::kCrowdStep);
  const PileBody& body = stages.members[stages.of(0)];
  EXPECT_LT((body.position - (Vec3(0, 0, 5) + test::kCrowdStep * velocity +
                              0.5 * test::kCrowdStep * test::kCrowdStep * world.gravity))
                .norm(),
            1e-15);
  EXPECT_LT((body.velocity - (velocity + test::kCrowdStep * world.gravity)).norm(), 1e-15);
  EXPECT_EQ(body.behind, 0);
  EXPECT_TRUE(stages.members.ways[stages.of(0)].moved);
  EXPECT_FALSE(stages.members.ways[stages.of(0)].pushed);
}

// What is pushed moves straight, and has the velocity of the middle of the step.
TEST(CrowdMotion, crateOnTheFloorIsHalfAStepBehind) {
  World world = floorWorld({});
  world.bodies.push_back(crate("a", Vec3::Constant(0.25), Vec3(0, 0, 0.25), {}));
  world.bodies[0].initial.velocity = Vec3(2, 0, 0);
  CrowdStages stages(world);
  stages.take(test::kCrowdStep);
  EXPECT_TRUE(stages.members.ways[stages.of(0)].pushed);
  EXPECT_EQ(stages.members[stages.of(0)].behind, 0.5 * test::kCrowdStep);
  EXPECT_NEAR(stages.members[stages.of(0)].position.x(), 2 * test::kCrowdStep, 1e-9);
  EXPECT_NEAR(stages.members[stages.of(0)].position.z(), 0.25, 1e-9);
}

TEST(CrowdMotion, impulsesChangeMomentumByInertia) {
  World world;
  world.bodies.push_back(crate("a", Vec3(0.25, 0.2, 0.3), Vec3(0, 0, 0), {}));
  CrowdStages stages(world);
  PileBody& body = stages.members[stages.of(0)];
  const Vec3 spin = spinBy(body, Vec3(0, 0, 6));
  EXPECT_NEAR(spin.z(), 6 * body.inverseInertiaBody.z(), 1e-15);
  takeVelocity(body, Vec3(1, 0, 0), spin);
  EXPECT_EQ(body.velocity, Vec3(1, 0, 0));
  EXPECT_LT((body.angularMomentum - Vec3(0, 0, 6)).norm(), 1e-14);
}

TEST(CrowdMotion, untouchedStepsAreThoseSinceSomethingWasNear) {
  World world = floorWorld({});
  world.bodies.push_back(crate("near", Vec3::Constant(0.25), Vec3(0, 0, 0.25), {}));
  world.bodies.push_back(crate("far", Vec3::Constant(0.25), Vec3(3, 0, 5), {}));
  world.bodies.push_back(world.bodies[1]);
  world.bodies[2].initial.pose.position.x() = 6;
  CrowdStages stages(world);
  stages.members[stages.of(2)].asleep = true;
  for (int step = 1; step < 4; ++step) {
    stages.meet(test::kCrowdStep);
    countUntouched(stages.members, stages.contacts, stages.memory);
    EXPECT_EQ(stages.memory.places[stages.of(0)].untouchedSteps, 0);
    EXPECT_EQ(stages.memory.places[stages.of(1)].untouchedSteps, step);
    EXPECT_EQ(stages.memory.places[stages.of(2)].untouchedSteps, 0);  // asleep
  }
}

}  // namespace
}  // namespace careen
