#include "physics/pile/crowd_contacts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/crates.h"
#include "support/crowd_stages.h"

namespace careen {
namespace {

using namespace test;

// A crate of half a metre that high over the floor.
World crateOverFloor(double gap, const Vec3& velocity = Vec3::Zero()) {
  World world = floorWorld({});
  world.gravity = Vec3::Zero();
  world.bodies.push_back(crate("a", Vec3::Constant(0.25), Vec3(0, 0, 0.25 + gap), {}));
  world.bodies[0].initial.velocity = velocity;
  return world;
}

TEST(CrowdContacts, crateNearTheFloorHasFourPointsAtItsGap) {
  const World world = crateOverFloor(0.003);
  CrowdStages stages(world);
  stages.meet(test::kCrowdStep);
  ASSERT_EQ(stages.contacts.near().size(), 1U);
  ASSERT_EQ(stages.manifold().count, 4);
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(stages.manifold().points[at(k)].gap, 0.003, 1e-15);
  }
  EXPECT_TRUE(stages.contacts.isNear(0));
}

// Far away, it is not looked at until it came as near as the reach of contact points, 1/32 of its size.
TEST(CrowdContacts, farCrateIsClearUntilItCameNear) {
  const World world = crateOverFloor(0.05, Vec3(0, 0, -1));
  CrowdStages stages(world);
  stages.meet(test::kCrowdStep);
  EXPECT_TRUE(stages.contacts.near().empty());
  ASSERT_EQ(stages.contacts.pairs().size(), 1U);
  const double left = 0.05 - 0.5 / 32;
  EXPECT_NEAR(stages.contacts.wayLeft(stages.contacts.pairs()[0]), left, 1e-15);
  EXPECT_TRUE(stages.contacts.isClear(stages.contacts.pairs()[0]));
  stages.members[stages.of(0)].position.z() -= 0.02;
  stages.members[stages.of(0)].path += 0.02;
  EXPECT_NEAR(stages.contacts.wayLeft(stages.contacts.pairs()[0]), left - 0.02, 1e-15);
  stages.members[stages.of(0)].position.z() -= 0.02;
  stages.members[stages.of(0)].path += 0.02;
  stages.meet(test::kCrowdStep);
  ASSERT_EQ(stages.contacts.near().size(), 1U);
  EXPECT_NEAR(stages.manifold().points[0].gap, 0.01, 1e-15);
}

TEST(CrowdContacts, sortingChangesSlotsAndNothingElse) {
  World world = crateOverFloor(0.003);
  world.bodies.push_back(crate("b", Vec3::Constant(0.25), Vec3(0.501, 0, 0.251), {}));
  CrowdStages stages(world);
  stages.meet(test::kCrowdStep);
  ASSERT_EQ(stages.contacts.near().size(), 3U);
  stages.manifold(1).points[0].normalImpulse = 7;
  const std::uint64_t key = stages.contacts.pairs()[1].key;
  stages.contacts.sort();
  EXPECT_TRUE(stages.contacts.near().empty());
  EXPECT_EQ(stages.contacts.pairs()[1].key, key);
  EXPECT_EQ(stages.contacts[stages.contacts.pairs()[1].slot].points[0].normalImpulse, 7);
  EXPECT_EQ(stages.contacts.pairs()[2].slot, 2);
}

TEST(CrowdContacts, pairsBesideSleepAreThoseOfWhichOneSleeps) {
  World world = crateOverFloor(0.003);
  world.bodies.push_back(crate("b", Vec3::Constant(0.25), Vec3(0.501, 0, 0.253), {}));
  CrowdStages stages(world);
  stages.members[stages.of(1)].asleep = true;
  stages.meet(test::kCrowdStep);
  ASSERT_EQ(stages.contacts.besideSleep().size(), 1U);
  const PilePair& pair = stages.contacts.pairs()[stages.contacts.besideSleep()[0]];
  EXPECT_TRUE(stages.members[pair.b].isBox());
}

}  // namespace
}  // namespace careen
