#include "physics/world/partner.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

TEST(Partner, isABodyOrAWallAndKnowsItsIndex) {
  EXPECT_EQ(Partner::ofBody(7).body(), 7);
  EXPECT_FALSE(Partner::ofBody(7).isWall());
  EXPECT_EQ(Partner::ofWall(7).wall(), 7U);
  EXPECT_TRUE(Partner::ofWall(7).isWall());
  EXPECT_NE(Partner::ofBody(7), Partner::ofWall(7));
  EXPECT_TRUE(Partner::ofBody(7).isBody(7));
  EXPECT_FALSE(Partner::ofWall(7).isBody(7));
  EXPECT_EQ(Partner(), Partner::ofWall(0));
}

TEST(Partner, sortsBodiesBeforeWalls) {
  const Partner sorted[] = {Partner::ofBody(0), Partner::ofBody(1000000), Partner::ofWall(0),
                            Partner::ofWall(3)};
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT(sorted[k], sorted[k + 1]);
  }
}

}  // namespace
}  // namespace careen
