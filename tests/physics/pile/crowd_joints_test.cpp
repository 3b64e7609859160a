#include "physics/pile/crowd_joints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/crates.h"
#include "support/crowd_stages.h"

namespace careen {
namespace {

using namespace test;

constexpr double kStep = 0.01;

// Two crates, face to face, of which the second one moved along x with these speeds in two steps of the same
// length.
bool isSharp(double before, double after) {
  World world;
  for (int k = 0; k < 2; ++k) {
    world.bodies.push_back(crate("crate" + std::to_string(k), Vec3::Constant(0.25), Vec3(0.5 * k, 0, 0), {}));
  }
  CrowdStages stages(world);
  stages.meet(kStep);
  const auto goOn = [&](double speed) {
    stages.members.begin();
    stages.members.ways[1].moved = true;
    stages.members[1].position.x() += kStep * speed;
  };
  stages.members[1].position.x() -= kStep * before;
  goOn(before);
  stages.joints.remember();
  EXPECT_NEAR(stages.memory.places[1].rates.velocity.x(), before, 1e-12);
  EXPECT_EQ(stages.memory.places[0].rates.velocity, Vec3(0, 0, 0));
  goOn(after);
  return stages.joints.isSharp();
}

// A smooth path cuts the corner that its steps make, on the side to which the velocity changes.
TEST(CrowdJoints, pathThatTurnsTowardsTheOtherThereIsSharp) {
  EXPECT_FALSE(isSharp(0, 0));
  EXPECT_FALSE(isSharp(-1, 1));  // a bounce: it turns before it is there
  EXPECT_FALSE(isSharp(0, 1));
  EXPECT_TRUE(isSharp(1, -1));  // its steps lead into the other
}

// What did not move remembers its velocity.
TEST(CrowdJoints, ratesOfWhatStoodStillAreItsVelocity) {
  World world;
  world.bodies.push_back(crate("a", Vec3::Constant(0.25), Vec3(0, 0, 0), {}));
  world.bodies[0].initial.velocity = Vec3(0, 2, 0);
  CrowdStages stages(world);
  stages.memory.places[0].past = 0.5;
  stages.joints.remember();
  EXPECT_EQ(stages.memory.places[0].rates.velocity, Vec3(0, 2, 0));
  EXPECT_EQ(stages.memory.places[0].past, 0.5);
}

}  // namespace
}  // namespace careen
