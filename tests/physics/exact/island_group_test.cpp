#include "physics/exact/island_group.h"

#include <gtest/gtest.h>

#include "support/started_bodies.h"

namespace careen {
namespace {

using test::cube;
using test::onFloor;
using test::StartedBodies;

// μ = ¼ on each side: the cube slides x = v t − μ g t²/2.
struct Sliding {
  StartedBodies all{onFloor({cube("a", {0, 0, 0.5}, {3, 0, 0}, {.friction = 0.25})}, 0.25)};
  std::shared_ptr<IslandGroup> island = all.settled(0).islands.at(0);

  static double x(double t) { return 3 * t - 1.25 * t * t; }
};

TEST(IslandGroup, movesItsBodiesFromStepToStep) {
  Sliding sliding;
  ASSERT_FALSE(sliding.island->begin(Instant(0)).has_value());
  const Mover& body = sliding.all.bodies[0];
  ASSERT_TRUE(body.steps());
  EXPECT_EQ(body.group, sliding.island);
  EXPECT_EQ(sliding.island->leader(), 0);
  const Instant end = sliding.island->end();
  EXPECT_GT(end.hi, 0);
  EXPECT_NEAR(body.stateAt(end).pose.position.x(), Sliding::x(end.hi), 1e-12);
  ASSERT_TRUE(sliding.island->goesOn());
  ASSERT_FALSE(sliding.island->advance(end).has_value());
  EXPECT_EQ(body.start.hi, end.hi);
  EXPECT_NEAR(body.stateAt(sliding.island->end()).pose.position.x(), Sliding::x(sliding.island->end().hi),
              1e-12);
}

TEST(IslandGroup, isKnownToItsTolerance) {
  Sliding sliding;
  EXPECT_LT(sliding.all.bodies[0].doubt.place, 1e-15);
  sliding.island->begin(Instant(0));
  EXPECT_EQ(sliding.all.bodies[0].doubt.place, 1e-6);
}

TEST(IslandGroup, endsItsStepWhereAnEncounterIs) {
  Sliding sliding;
  sliding.island->begin(Instant(0));
  const double half = sliding.island->end().hi / 2;
  Encounter encounter;
  encounter.time = Instant(half);
  EXPECT_TRUE(sliding.island->enter(encounter, 0));
  ASSERT_EQ(encounter.bodies.size(), 1U);
  EXPECT_NEAR(encounter.bodies[0].before.pose.position.x(), Sliding::x(half), 1e-12);
  EXPECT_EQ(sliding.island->length(), half);
  std::vector<ContactFeature> features;
  sliding.island->addFeatures(encounter, features);
  EXPECT_EQ(features.size(), 4U);
}

TEST(IslandGroup, seesToContactsOfItsBodies) {
  const Vec3 left(-0.5, 0, 0);
  StartedBodies all(onFloor({cube("a", {0, 0, 0.5}), cube("b", {0, 0, 1.5}, left), cube("c", {9, 0, 0.5})}));
  const std::shared_ptr<IslandGroup> island = all.settled(0).islands.at(0);
  island->begin(Instant(0));
  EXPECT_TRUE(island->seesTo(0, 0, {1, 0}));
  EXPECT_FALSE(island->seesTo(0, 0, {2, 0}));
}

// The account is told of the energy that sliding takes, and so finds none missing.
TEST(IslandGroup, mayLoseEnergyByFriction) {
  Sliding sliding;
  sliding.island->begin(Instant(0));
  FlightAccount& account = sliding.all.bodies.account();
  account.parted();
  const Instant end = sliding.island->end();
  sliding.island->advance(end);
  EXPECT_LT(sliding.all.bodies[0].stateAt(end).velocity.x(), 3);
  EXPECT_EQ(account.figures().energyChange, 0);
  BodyState deeper = sliding.all.bodies[0].stateAt(end);
  deeper.pose.position.z() -= 0.09;
  account.departs(0, deeper);
  account.parted();
  EXPECT_NEAR(account.figures().energyChange, 0.9 / 4.5, 1e-6);  // nobody has told of that
}

}  // namespace
}  // namespace careen
