#include "physics/exact/encounter.h"

#include <gtest/gtest.h>

#include "support/started_bodies.h"

namespace careen {
namespace {

using test::afloat;
using test::cube;
using test::held;
using test::StartedBodies;

Encounter at(StartedBodies& all, int rank) {
  return gather(all.bodies, {.time = Instant(0), .kind = EventKind::kContact, .body = rank});
}

TEST(Encounter, reachesAllThatTouchOneItReaches) {
  StartedBodies all(
      afloat({cube("c", {2, 0, 0}), cube("a", {0, 0, 0}), cube("b", {1, 0, 0}), cube("d", {3.1, 0, 0})}));
  EXPECT_EQ(at(all, 1).ranks(), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(at(all, 3).ranks(), (std::vector<int>{3}));
}

TEST(Encounter, doesNotReachThroughHeldBodies) {
  StartedBodies all(afloat({cube("a", {0, 0, 0}), held(cube("b", {1, 0, 0})), cube("c", {2, 0, 0})}));
  EXPECT_EQ(at(all, 0).ranks(), (std::vector<int>{0, 1}));
}

TEST(Encounter, takesAlongWhomSpringsJoin) {
  World world = afloat({cube("a", {0, 0, 0}), cube("b", {5, 0, 0}), cube("c", {9, 0, 0})});
  world.springs = {{.from = {.body = 0, .point = Vec3::Zero()}, .to = {.body = 2, .point = Vec3::Zero()}}};
  StartedBodies all(world);
  EXPECT_EQ(at(all, 2).ranks(), (std::vector<int>{0, 2}));
}

TEST(Encounter, knowsItsBodiesByRankAndHowTheyMove) {
  StartedBodies all(afloat({cube("a", {7, 0, 0}), cube("b", {0, 0, 0}, {1, 2, 3}), cube("c", {1, 0, 0})}));
  const Encounter encounter =
      gather(all.bodies, {.time = Instant(0.5), .kind = EventKind::kContact, .body = 1});
  ASSERT_EQ(encounter.indexOf(1), 0U);
  EXPECT_EQ(encounter.bodies[0].before.pose.position, Vec3(0.5, 1, 1.5));
  EXPECT_EQ(encounter.bodies[0].after.velocity, Vec3(1, 2, 3));
  const std::vector<BodyState> states = statesIn(all.world, encounter, &EncounterBody::before);
  EXPECT_EQ(states[0].pose.position, Vec3(7, 0, 0));
  EXPECT_EQ(states[1].pose.position, Vec3(0.5, 1, 1.5));
}

// By gravity of 10 m/s² in the time scale of 1e-6 m, sqrt(1e-6/10) s.
TEST(Encounter, fallsThroughTheToleranceAtThatSpeed) {
  StartedBodies all(test::onFloor({cube("a", {0, 0, 5})}));
  EXPECT_NEAR(fallSpeed(all.bodies, at(all, 0)), std::sqrt(1e-5), 1e-15);
  StartedBodies still(afloat({cube("a", {0, 0, 5})}));
  EXPECT_EQ(fallSpeed(still.bodies, at(still, 0)), 0);
}

// Faces 1e-3 m apart: both impulses act halfway. Where the gap is rounding, the arms stay.
TEST(Encounter, joinsTheTwoPointsOfAContact) {
  StartedBodies all(afloat({cube("a", {0, 0, 1.001}), cube("b", {0, 0, 0})}));
  Encounter encounter;
  for (const int rank : {0, 1}) {
    const BodyState state = all.bodies[rank].body->initial;
    encounter.bodies.push_back({.mover = &all.bodies[rank], .before = state, .after = state});
  }
  encounter.contacts = {{.b = 1, .armA = {0, 0, -0.5}, .armB = {0, 0, 0.5}}};
  EXPECT_NEAR(encounter.joined(0).armA.z(), -0.5005, 1e-15);
  EXPECT_NEAR(encounter.joined(0).armB.z(), 0.5005, 1e-15);
  EXPECT_NEAR(encounter.lengthsAt(0), 1.001 + 2 * std::sqrt(0.75), 1e-15);
  encounter.bodies[0].after.pose.position.z() = 1 + 0x1p-50;
  EXPECT_EQ(encounter.joined(0).armA.z(), -0.5);
  const Wall wall;
  Mover floor;
  floor.body = &bodyOfWalls();
  floor.halfSpace = &wall;
  encounter.bodies.push_back({.mover = &floor});
  encounter.contacts[0].b = 2;
  EXPECT_EQ(encounter.joined(0).armA.z(), -0.5);
}

}  // namespace
}  // namespace careen
