#include "physics/exact/aftermath.h"

#include <gtest/gtest.h>

#include "physics/exact/island_group.h"
#include "support/started_bodies.h"

namespace careen {
namespace {

using test::cube;
using test::onFloor;
using test::StartedBodies;

TEST(Aftermath, ofABounceIsFlight) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}, {1, 0, -2}, {.restitution = 0.5})}));
  const Encounter settled = all.settled(0);
  EXPECT_EQ(settled.bodies[0].next, NextMotion::kFlies);
  EXPECT_NEAR(settled.bodies[0].after.velocity.z(), 1, 1e-15);
  EXPECT_TRUE(settled.islands.empty());
}

TEST(Aftermath, ofALandingWithoutRestitutionIsRest) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}, {0, 0, -2})}, 0.5));
  const Encounter settled = all.settled(0);
  EXPECT_EQ(settled.bodies[0].next, NextMotion::kRests);
  EXPECT_EQ(settled.bodies[0].since.hi, 0);
  EXPECT_EQ(settled.bodies[0].after.velocity, Vec3::Zero());
}

// Hops of 1e-7 m/s with e = ½ last 2 · .5e-7/(10 · .5) s in all: too short to follow.
TEST(Aftermath, ofHopsTooShortToFollowIsRestWhenTheyHaveEnded) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}, {0, 0, -1e-7}, {.restitution = 0.5})}, 0.5));
  const Encounter settled = all.settled(0);
  ASSERT_EQ(settled.bodies[0].next, NextMotion::kRests);
  EXPECT_NEAR(settled.bodies[0].since.hi, 2e-8, 1e-20);
}

TEST(Aftermath, ofSlidingIsAnIsland) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}, {1, 0, 0}, {.friction = 0.1})}, 0.1));
  const Encounter settled = all.settled(0);
  EXPECT_EQ(settled.bodies[0].next, NextMotion::kSteps);
  ASSERT_EQ(settled.islands.size(), 1U);
  EXPECT_EQ(settled.islands[0]->ranks(), (std::vector<int>{0, 1}));  // it and the floor
  EXPECT_EQ(settled.timeSteps, 0);
}

// More than twelve changes of contact within a moment: time steps, twice as many when that was not enough.
TEST(Aftermath, ofChatteringIsTimeSteps) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}, {0, 0, -1}), cube("b", {0, 0, 1.5}, {0, 0, -1})}));
  for (int k = 0; k < 12; ++k) {
    EXPECT_EQ(all.settled(0).timeSteps, 0) << k;
  }
  EXPECT_EQ(all.settled(0).timeSteps, 16);
  EXPECT_EQ(all.bodies[1].timeSteps, 16);
  EXPECT_EQ(all.settled(0).timeSteps, 32);
}

// A point at (½, 0, −½) of a body that moves at (1, 0, 2) and spins at 4 about y: 4 y × r = (−2, 0, −2).
TEST(Aftermath, isKnownByThePartingOfPoints) {
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5})}));
  Encounter encounter = all.encounter(0);
  EncounterBody& body = encounter.bodies[0];
  body.after.velocity = Vec3(1, 0, 2);
  body.after.angularMomentum =
      angularMomentum(body.body().mass, body.after.pose.worldFromBody, Vec3(0, 4, 0));
  encounter.contacts = {{.b = 1, .armA = {0.5, 0, -0.5}, .normal = Vec3::UnitZ()}};
  const Parting parting = partingAt(encounter, 0);
  EXPECT_NEAR((parting.velocity - Vec3(-1, 0, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR(parting.speed, 0, 1e-15);
  EXPECT_GT(parting.rounding, 0);
  EXPECT_LT(parting.rounding, 1e-10);
}

}  // namespace
}  // namespace careen
