#include "physics/pile/crowd_seams.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/crates.h"
#include "support/crowd_stages.h"

namespace careen {
namespace {

using namespace test;

constexpr double kJointStep = 0.01;

// Two crates, the second one at that place from the first after a step with one speed, before one of the same
// length with the other.
bool isSharp(const Vec3& place, const Vec3& before, const Vec3& after) {
  World world;
  world.bodies.push_back(crate("a", Vec3::Constant(0.25), Vec3::Zero(), {}));
  world.bodies.push_back(crate("b", Vec3::Constant(0.25), place, {}));
  CrowdStages stages(world);
  stages.meet(kJointStep);
  const auto goOn = [&](const Vec3& velocity) {
    stages.members.begin();
    stages.members.ways[1].moved = true;
    stages.members[1].position += kJointStep * velocity;
  };
  stages.members[1].position -= kJointStep * before;
  goOn(before);
  stages.seams.remember();
  EXPECT_LT((stages.memory.places[1].rates.velocity - before).norm(), 1e-12);
  EXPECT_EQ(stages.memory.places[0].rates.velocity, Vec3(0, 0, 0));
  goOn(after);
  return stages.seams.isSharp();
}

// A smooth path cuts the corner that its steps make, on the side to which the velocity changes: here through
// the edge that they go around, along one face and then along the next.
TEST(CrowdSeams, pathThatWouldCutThroughAnEdgeIsSharp) {
  const Vec3 atEdge(0.5, 0.5, 0);
  EXPECT_TRUE(isSharp(atEdge, Vec3(0, 3, 0), Vec3(-3, 0, 0)));
  EXPECT_FALSE(isSharp(atEdge, Vec3(0, 0.1, 0), Vec3(-0.1, 0, 0)));  // by less than half a tolerance
  EXPECT_FALSE(isSharp(atEdge, Vec3(-3, 0, 0), Vec3(0, 3, 0)));      // the change leads away
}

TEST(CrowdSeams, pathOfABounceIsSmooth) {
  const Vec3 atFace(0.5, 0, 0);
  EXPECT_FALSE(isSharp(atFace, Vec3(-1, 0, 0), Vec3(1, 0, 0)));  // it turns before it is there
  EXPECT_TRUE(isSharp(atFace, Vec3(1, 0, 0), Vec3(-1, 0, 0)));   // its steps lead into the other
}

// What did not move remembers its velocity.
TEST(CrowdSeams, ratesOfWhatStoodStillAreItsVelocity) {
  World world;
  world.bodies.push_back(crate("a", Vec3::Constant(0.25), Vec3(0, 0, 0), {}));
  world.bodies[0].initial.velocity = Vec3(0, 2, 0);
  CrowdStages stages(world);
  stages.memory.places[0].past = 0.5;
  stages.seams.remember();
  EXPECT_EQ(stages.memory.places[0].rates.velocity, Vec3(0, 2, 0));
  EXPECT_EQ(stages.memory.places[0].past, 0.5);
}

}  // namespace
}  // namespace careen
