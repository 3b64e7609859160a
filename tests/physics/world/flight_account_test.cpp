#include "physics/world/flight_account.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/rotation.h"
#include "support/physics_worlds.h"

namespace careen {
namespace {

// A box of 8 kg with half sizes 1 m at 3 m/s: 36 J.
World drifting() {
  World world;
  world.bodies = {makeBox({.halfExtents = {1, 1, 1}, .velocity = {1, 2, 2}, .density = 1})};
  return world;
}

BodyState at(const World& world, double speed) {
  BodyState state = world.bodies[0].initial;
  state.velocity *= speed / 3;
  return state;
}

// It arrives with 27 J although nothing may take energy: 9 of the 36 J.
TEST(FlightAccount, tellsAChangeOfEnergyInFlight) {
  const World world = drifting();
  FlightAccount account(world);
  account.departs(0, at(world, 3));
  account.parted();
  account.arrives(0, at(world, 3), 1);
  EXPECT_EQ(account.figures().energyChange, 0);
  EXPECT_EQ(account.figures().momentumChange, 0);
  account.departs(0, at(world, 3));
  account.parted();
  account.arrives(0, at(world, 1.5 * std::sqrt(3.0)), 1);
  EXPECT_NEAR(account.figures().energyChange, 0.25, 1e-15);
  // p: 24 and 24 √3/2.
  EXPECT_NEAR(account.figures().momentumChange, 1 - std::sqrt(0.75), 1e-15);
}

// An impact that may lose takes 27 of 36 J without a word; one that may not is told of.
TEST(FlightAccount, allowsLossesToImpactsThatMayLose) {
  for (const bool mayLose : {true, false}) {
    const World world = drifting();
    FlightAccount account(world);
    account.departs(0, at(world, 3));
    account.parted();
    account.arrives(0, at(world, 3), 1);
    if (mayLose) {
      account.mayLose();
    }
    account.departs(0, at(world, 1.5));
    account.parted();
    account.arrives(0, at(world, 1.5), 1);
    EXPECT_NEAR(account.figures().energyChange, mayLose ? 0 : 0.75, 1e-15);
  }
}

// From 36 J to 49 J: never allowed.
TEST(FlightAccount, neverAllowsARise) {
  const World world = drifting();
  FlightAccount account(world);
  account.departs(0, at(world, 3));
  account.parted();
  account.arrives(0, at(world, 3), 1);
  account.mayLose();
  account.departs(0, at(world, 3.5));
  account.parted();
  EXPECT_NEAR(account.figures().energyChange, (49.0 - 36) / 49, 1e-15);
}

// Weight changes momentum by M g t and moves energy to and fro: x = −5 t², v = −10 t.
TEST(FlightAccount, knowsWhatWeightDoes) {
  World world = drifting();
  world.gravity = {0, 0, -10};
  FlightAccount account(world);
  BodyState state = world.bodies[0].initial;
  state.velocity.setZero();
  account.departs(0, state);
  account.parted();
  state.pose.position.z() = -20;
  state.velocity.z() = -20;
  account.arrives(0, state, 2);
  EXPECT_EQ(account.figures().energyChange, 0);
  EXPECT_EQ(account.figures().momentumChange, 0);
}

// k = 4 N/m stretched by 3 m: 18 J, which half its kinetic energy of 36 J pays for.
TEST(FlightAccount, countsWhatSpringsHold) {
  World world = drifting();
  world.springs = {{.from = {.body = 0}, .to = {}, .stiffness = 4}};
  FlightAccount account(world);
  account.departs(0, at(world, 3));
  account.parted();
  BodyState stretched = at(world, 3 * std::sqrt(0.5));
  stretched.pose.position = {3, 0, 0};
  account.passes(0, stretched);
  EXPECT_NEAR(account.figures().energyChange, 0, 1e-15);
  stretched.pose.position = {4, 0, 0};  // 32 J
  account.passes(0, stretched);
  EXPECT_NEAR(account.figures().energyChange, 14.0 / 36, 1e-15);
}

TEST(FlightAccount, remembersTheDeepestPenetrationTheWorstMatrixAndWhenItWasBounded) {
  const World world = drifting();
  FlightAccount account(world);
  EXPECT_FALSE(account.figures().boundedFrom.has_value());
  account.penetrates(0.25);
  account.penetrates(0.125);
  account.losesPlaces(5);
  EXPECT_EQ(account.figures().horizon, 5);
  account.bounds(3);
  account.losesPlaces(4);
  BodyState skew = at(world, 3);
  skew.pose.worldFromBody *= 1.5;
  account.departs(0, skew);
  account.departs(0, at(world, 3));
  EXPECT_EQ(account.figures().deepestPenetration, 0.25);
  EXPECT_EQ(account.figures().boundedFrom, 3);
  EXPECT_EQ(account.figures().horizon, 3);
  EXPECT_EQ(account.figures().orthogonality, orthogonalityError(skew.pose.worldFromBody));
  EXPECT_GT(account.figures().orthogonality, 1);
}

}  // namespace
}  // namespace careen
