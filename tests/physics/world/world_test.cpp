#include "physics/world/world.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

TEST(World, endsNowhere) {
  EXPECT_FALSE(nowhere().normal.dot(Vec3::Zero()) - nowhere().offset < 1e300);
  EXPECT_EQ(&nowhere(), &nowhere());
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
