#include "physics/world/partner.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

// Bodies count from 0 upward, walls from −1 downward.
TEST(Partner, ofAWallIsNegativeAndTellsWhichWall) {
  EXPECT_EQ(wallPartner(0), -1);
  EXPECT_EQ(wallPartner(5), -6);
  for (std::size_t wall = 0; wall < 100; ++wall) {
    EXPECT_LT(wallPartner(wall), 0);
    EXPECT_EQ(wallOf(wallPartner(wall)), wall);
  }
}

}  // namespace
}  // namespace careen
