#include "physics/contact/three_at.h"

#include <gtest/gtest.h>

#include <vector>

namespace careen {
namespace {

TEST(ThreeAt, isReadAndWrittenInItsPlaceOnly) {
  std::vector<double> y{0, 1, 2, 3, 4, 5, 6};
  EXPECT_EQ(threeAt(y, 3), (Vec3{3, 4, 5}));
  setThree(y, 2, {-1, -2, -3});
  EXPECT_EQ(y, (std::vector<double>{0, 1, -1, -2, -3, 5, 6}));
  EXPECT_EQ(threeAt(y, 2), (Vec3{-1, -2, -3}));
}

}  // namespace
}  // namespace careen
