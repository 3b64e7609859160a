#include "physics/compared/collision1997.h"

#include <gtest/gtest.h>

#include "support/physics_worlds.h"

namespace careen {
namespace {

/// A cube of half size 0.2 m whose lowest corners are `height` over the floor.
World overTheFloor(double height, const Vec3& velocity, const Vec3& angularVelocity = Vec3::Zero()) {
  World world;
  world.walls = {floorAt(0)};
  world.bodies = {
      makeBox({.position = {0, 0, 0.2 + height}, .velocity = velocity, .angularVelocity = angularVelocity})};
  return world;
}

CornerCheck check(const World& world) {
  std::vector<BodyState> states;
  for (const Body& body : world.bodies) {
    states.push_back(body.initial);
  }
  return checkCorners(world, states);
}

TEST(CheckCorners, isClearAboveTheLayer) {
  const CornerCheck result = check(overTheFloor(0.0011, {0, 0, -5}));
  EXPECT_EQ(result.state, CornerState::kClear);
  EXPECT_EQ(result.deepest, 0);
}

TEST(CheckCorners, collidesInsideTheLayerWhileClosingIn) {
  for (const double height : {0.0009, 0.0, -0.0009}) {
    EXPECT_EQ(check(overTheFloor(height, {0, 0, -5})).state, CornerState::kColliding) << height;
    EXPECT_EQ(check(overTheFloor(height, {0, 0, 0})).state, CornerState::kClear) << "not moving";
    EXPECT_EQ(check(overTheFloor(height, {3, 0, 5})).state, CornerState::kClear) << "leaving";
  }
}

TEST(CheckCorners, penetratesBelowTheLayerWhereverItMoves) {
  for (const double speed : {-5.0, 5.0}) {
    const CornerCheck result = check(overTheFloor(-0.0011, {0, 0, speed}));
    EXPECT_EQ(result.state, CornerState::kPenetrating);
    EXPECT_NEAR(result.deepest, 0.0011, 1e-16);
    EXPECT_NEAR(result.corner.gap, -0.0011, 1e-16);
  }
}

// Corner 7 (−,−,−) is the last of the four below.
TEST(CheckCorners, remembersTheLastCollidingCorner) {
  const CornerCheck result = check(overTheFloor(0, {0, 0, -5}));
  EXPECT_LT((result.corner.point - Vec3(-0.2, -0.2, 0)).norm(), 1e-16);
}

// Corner 1 (+,+,−) is the first.
TEST(CheckCorners, stopsAtTheFirstPenetratingCorner) {
  const CornerCheck result = check(overTheFloor(-0.1, {0, 0, -5}));
  EXPECT_LT((result.corner.point - Vec3(0.2, 0.2, -0.1)).norm(), 1e-16);
}

// The centre rises at 1 m/s, but at ω_y = 10 the corners at x = +0.2 go down at 2 m/s: 3 is the last of them.
TEST(CheckCorners, asksForTheSpeedOfTheCornerNotOfTheCenter) {
  const CornerCheck result = check(overTheFloor(0, {0, 0, 1}, {0, 10, 0}));
  EXPECT_EQ(result.state, CornerState::kColliding);
  EXPECT_LT((result.corner.point - Vec3(0.2, -0.2, 0)).norm(), 1e-16);
}

TEST(CheckCorners, takesBodiesAndWallsInTheirOrder) {
  World world = overTheFloor(0, {0, 0, -5});
  world.walls.insert(world.walls.begin(), floorAt(-10));
  world.bodies.push_back(world.bodies[0]);
  const CornerCheck result = check(world);
  EXPECT_EQ(result.corner.body.value, 1) << "the last body";
  EXPECT_EQ(result.corner.wall, 1U);
}

TEST(CheckCorners, passesOverHeldBodies) {
  World world = overTheFloor(-0.1, {0, 0, 0});
  world.bodies[0].mass = immovable();
  EXPECT_EQ(check(world).state, CornerState::kClear);
}

// Corner 7 of a cube, m = 0.0256, falling at 5 m/s: r × n = (−s, s, 0), I = 2/3 m s², so that
// j = (1+e) 5 / (1/m + 2 s²/I) = (1+e) 5 m / 4.
TEST(ResolveCorner, reportsTheImpactAndItsEnergy) {
  World world = overTheFloor(0, {0, 0, -5});
  world.bodies[0].material.restitution = 0.25;
  world.walls[0].material.restitution = 0.5;
  std::vector<BodyState> states = {world.bodies[0].initial};
  const CornerCheck found = checkCorners(world, states);
  const ResolvedCorner resolved = resolveCorner(world, found.corner, 1.25, states);
  const double mass = 0.0256;
  EXPECT_EQ(resolved.impact.time, 1.25);
  EXPECT_EQ(resolved.impact.a.value, 0);
  EXPECT_EQ(resolved.impact.b, Partner::ofWall(0));
  EXPECT_EQ(resolved.impact.normal, Vec3::UnitZ());
  EXPECT_EQ(resolved.impact.point, found.corner.point);
  EXPECT_EQ(resolved.impact.approach, 5);
  EXPECT_NEAR(resolved.impact.impulse, 1.5 * 5 * mass / 4, 1e-16) << "the livelier restitution, 0.5";
  EXPECT_EQ(resolved.impact.tangential, 0);
  EXPECT_NEAR(states[0].velocity.z(), -5 + 1.5 * 5 / 4, 1e-15);
  EXPECT_NEAR(resolved.energyChange, -0.5 * 0.5 * (1.5 * 5 * mass / 4) * 5, 1e-16);
}

}  // namespace
}  // namespace careen
