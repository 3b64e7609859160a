#include "physics/exact/island_forming.h"

#include <gtest/gtest.h>

#include "physics/exact/island_group.h"
#include "support/started_bodies.h"

namespace careen {
namespace {

using test::afloat;
using test::cube;
using test::held;
using test::onFloor;
using test::StartedBodies;

Encounter formed(StartedBodies& all, int rank, char persists) {
  Encounter encounter = all.encounter(rank);
  for (EncounterBody& body : encounter.bodies) {
    body.next = body.mover->isHeld() ? NextMotion::kGoesOn : NextMotion::kFlies;
  }
  encounter.persists.assign(encounter.contacts.size(), persists);
  formIslands(all.bodies, encounter);
  return encounter;
}

// Two towers beside each other on a beam that is held: each is an island with the beam.
TEST(IslandForming, joinsWhatTouchesButNotThroughHeldBodies) {
  Body beam = held(box("beam", {5, 0.5, 0.5}, 1, {0, 0, 0.5}));
  const Vec3 slow(0.1, 0, 0);
  StartedBodies all(onFloor(
      {cube("a", {-2, 0, 1.5}, slow), cube("b", {-2, 0, 2.5}, -slow), beam, cube("c", {2, 0, 1.5}, slow)}));
  Encounter encounter = formed(all, 0, 1);
  ASSERT_EQ(encounter.ranks(), (std::vector<int>{0, 1, 2, 4}));  // 4: the floor
  ASSERT_EQ(encounter.islands.size(), 1U);
  EXPECT_EQ(encounter.islands[0]->ranks(), (std::vector<int>{0, 1, 2, 4}));
  EXPECT_EQ(encounter.bodies[1].next, NextMotion::kSteps);
  EXPECT_EQ(encounter.bodies[2].next, NextMotion::kGoesOn);
}

TEST(IslandForming, letsFlyWhatNoContactHolds) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}, {0.1, 0, 0})}));
  const Encounter encounter = formed(all, 0, 0);
  EXPECT_TRUE(encounter.islands.empty());
  EXPECT_EQ(encounter.bodies[0].next, NextMotion::kFlies);
}

// Without gravity nothing pushes them together.
TEST(IslandForming, letsFlyWhatDoesNotPush) {
  StartedBodies all(afloat({cube("a", {0, 0, 0}, {0, 0, 0.1}), cube("b", {1, 0, 0})}));
  const Encounter encounter = formed(all, 0, 1);
  EXPECT_TRUE(encounter.islands.empty());
  EXPECT_EQ(encounter.bodies[1].next, NextMotion::kFlies);
}

TEST(IslandForming, letsRestWhatNothingMoves) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}), cube("b", {0, 0, 1.5})}));
  const Encounter encounter = formed(all, 0, 1);
  EXPECT_TRUE(encounter.islands.empty());
  EXPECT_EQ(encounter.bodies[0].next, NextMotion::kRests);
  EXPECT_EQ(encounter.bodies[1].next, NextMotion::kRests);
}

TEST(IslandForming, comparesMotionsToTheBit) {
  BodyState state{.velocity = {1, 2, 3}};
  BodyState other = state;
  other.pose.position.x() = 5;
  EXPECT_TRUE(movesAlike(state, other));
  other.velocity.x() += 0x1p-50;
  EXPECT_FALSE(movesAlike(state, other));
}

}  // namespace
}  // namespace careen
