#include "physics/world/world.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

TEST(World, endsNowhere) {
  EXPECT_FALSE(nowhere().normal.dot(Vec3::Zero()) - nowhere().offset < 1e300);
  EXPECT_EQ(&nowhere(), &nowhere());
}

// A wall through (1, 0, 0) that turns about it by a right angle in a second while that goes up at 2 m/s.
TEST(World, tellsWhereAWallIs) {
  Wall wall{.name = "wall", .normal = Vec3::UnitX(), .offset = 1, .material = {}};
  EXPECT_EQ(planeAt(wall, 5).offset, 1);
  World world;
  world.walls = {wall};
  EXPECT_FALSE(hasCourses(world));
  wall.course = courseOf({.path = {},
                          .velocity = Vec3(0, 0, 2),
                          .angularVelocity = Vec3(0, 0, 1.57079632679489662),
                          .about = Vec3(1, 0, 0)},
                         {.position = Vec3(1, 0, 0)});
  world.walls = {wall};
  EXPECT_TRUE(hasCourses(world));
  EXPECT_EQ(whatHasCourses(world), "walls");
  EXPECT_EQ(planeAt(wall, 0).normal, Vec3::UnitX());
  EXPECT_EQ(planeAt(wall, 0).offset, 1);
  EXPECT_LT((planeAt(wall, 1).normal - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_NEAR(planeAt(wall, 1).offset, 0, 1e-15);
  EXPECT_EQ(wallMotion(wall, 1).pose.position, Vec3(1, 0, 2));
}

// 2 until 1 s, then 5 until 3 s, then −1, along x: of 0.5 to 4 s (0.5 · 2 + 2 · 5 − 1)/3.5.
TEST(World, tellsGravityAtAnyTime) {
  World world;
  world.gravity = Vec3(2, 0, 0);
  EXPECT_EQ(gravityAt(world, 7), Vec3(2, 0, 0));
  EXPECT_EQ(meanGravity(world, 0, 7), Vec3(2, 0, 0));
  world.gravityChanges = {{.time = 1, .gravity = Vec3(5, 0, 0)}, {.time = 3, .gravity = Vec3(-1, 0, 0)}};
  EXPECT_EQ(gravityAt(world, 0).x(), 2);
  EXPECT_EQ(gravityAt(world, 0.999).x(), 2);
  EXPECT_EQ(gravityAt(world, 1).x(), 5);
  EXPECT_EQ(gravityAt(world, 2.9).x(), 5);
  EXPECT_EQ(gravityAt(world, 9).x(), -1);
  EXPECT_NEAR(meanGravity(world, 0.5, 4).x(), 10 / 3.5, 1e-15);
  EXPECT_EQ(meanGravity(world, 1, 3).x(), 5);
  EXPECT_EQ(meanGravity(world, 3, 3).x(), -1);
  EXPECT_EQ(mostGravity(world), 5);
}

// From 2 at 0 s to 5 at 1 s and −1 at 3 s, along x: of 0.5 to 2 s (0.5 · 4.25 + 1 · 3.5)/1.5; of 0 to 4 s
// (1 · 3.5 + 2 · 2 − 1)/4. Where it changes next it goes straight on.
TEST(World, tellsGravityThatSlopes) {
  World world;
  world.gravity = Vec3(2, 0, 0);
  world.gravityPath = GravityPath::kLinear;
  world.gravityChanges = {{.time = 1, .gravity = Vec3(5, 0, 0)}, {.time = 3, .gravity = Vec3(-1, 0, 0)}};
  EXPECT_EQ(gravityAt(world, 0).x(), 2);
  EXPECT_EQ(gravityAt(world, 0.5).x(), 3.5);
  EXPECT_EQ(gravityAt(world, 1).x(), 5);
  EXPECT_EQ(gravityAt(world, 2).x(), 2);
  EXPECT_EQ(gravityAt(world, 9).x(), -1);
  EXPECT_NEAR(meanGravity(world, 0.5, 2).x(), (0.5 * 4.25 + 3.5) / 1.5, 1e-15);
  EXPECT_NEAR(meanGravity(world, 0, 4).x(), 6.5 / 4, 1e-15);
  EXPECT_EQ(meanGravity(world, 0.5, 0.5).x(), 3.5);
  EXPECT_TRUE(isGravitySloping(world));
  EXPECT_EQ(gravitySlope(world), Vec3(3, 0, 0));
  EXPECT_EQ(gravityNow(world, 1.5).x(), 6.5);
  EXPECT_EQ(gravityScale(world), 5);
  world.gravityChanges.front().gravity = world.gravity;
  EXPECT_FALSE(isGravitySloping(world));
  EXPECT_EQ(gravitySlope(world), Vec3(0, 0, 0));
  world.gravityChanges.clear();
  EXPECT_FALSE(isGravitySloping(world));
  EXPECT_EQ(gravityAt(world, 3), world.gravity);
}

TEST(World, letsThoseThroughThatItNames) {
  World world;
  EXPECT_TRUE(mayTouch(world, 0, 1));
  world.apart = {{0, 2}, {1, 3}};
  EXPECT_FALSE(mayTouch(world, 0, 2));
  EXPECT_FALSE(mayTouch(world, 3, 1));
  EXPECT_TRUE(mayTouch(world, 0, 1));
  EXPECT_TRUE(mayTouch(world, 2, 3));
}

}  // namespace
}  // namespace careen
