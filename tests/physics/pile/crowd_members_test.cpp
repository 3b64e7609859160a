#include "physics/pile/crowd_members.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/crates.h"
#include "support/crowd_stages.h"

namespace careen {
namespace {

using namespace test;

World threeCrates() {
  World world;
  for (int k = 0; k < 3; ++k) {
    world.bodies.push_back(crate("crate" + std::to_string(k), Vec3::Constant(0.25), Vec3(k, 0, 0), {}));
  }
  return world;
}

TEST(CrowdMembers, placeThatWasLeftIsUsedAgain) {
  const World world = threeCrates();
  CrowdStages stages(world);
  stages.members.remove(1);
  EXPECT_TRUE(stages.members[1].absent);
  EXPECT_TRUE(stages.members[1].still());
  EXPECT_EQ(stages.members.add(pileBody(world.bodies[2], world.bodies[2].initial), 2), 1U);
  EXPECT_EQ(stages.members.listed[1], 2U);
  EXPECT_EQ(stages.members.size(), 3U);
}

// Back where it began, but awake and with the way that it went, there and back.
TEST(CrowdMembers, goBackButForWhatTheStepWoke) {
  const World world = threeCrates();
  CrowdStages stages(world);
  stages.members[0].asleep = true;
  stages.members[0].cluster = 0;
  stages.members.begin();
  stages.members[0].asleep = false;
  stages.members[1].position += Vec3(0, 0, 0.5);
  stages.members[1].path = 0.5;
  stages.members.goBack();
  EXPECT_FALSE(stages.members[0].asleep);
  EXPECT_EQ(stages.members[0].cluster, -1);
  EXPECT_EQ(stages.members[1].position, Vec3(1, 0, 0));
  EXPECT_EQ(stages.members[1].path, 0.5);
}

TEST(CrowdMembers, halfTheWayIsHalfOfBothWayAndTurn) {
  const World world = threeCrates();
  CrowdStages stages(world);
  stages.members.begin();
  stages.members[1].position += Vec3(0, 0, 0.5);
  turnBy(stages.members[1], Vec3(0, 0, 0.2));
  const Pose half = stages.members.between(1, 0.5);
  EXPECT_LT((half.position - Vec3(1, 0, 0.25)).norm(), 1e-15);
  EXPECT_NEAR(half.worldFromBody(1, 0), std::sin(0.1), 1e-12);
  EXPECT_EQ(stages.members.apart(1, 0), Vec3(1, 0, 0.5));
}

}  // namespace
}  // namespace careen
