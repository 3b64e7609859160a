#include "core/math/lanes.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

TEST(Lanes, rowsBecomeColumns) {
  Lanes a{11, 12, 13, 14};
  Lanes b{21, 22, 23, 24};
  Lanes c{31, 32, 33, 34};
  Lanes d{41, 42, 43, 44};
  transpose(a, b, c, d);
  int column = 0;
  for (const Lanes& each : {a, b, c, d}) {
    ++column;
    for (int row = 0; row < kLanes; ++row) {
      EXPECT_EQ(each[row], 10 * (row + 1) + column);
    }
  }
}

// Each lane by itself: x × y = z, of vectors as long as the number of the lane.
TEST(Lanes, vectorsAreThoseOfTheirLanes) {
  LanesVec x{};
  LanesVec y{};
  for (int lane = 0; lane < kLanes; ++lane) {
    setLane(x, lane, lane, 0, 0);
    setLane(y, lane, 0, lane, 0);
  }
  const LanesVec z = cross(x, y);
  for (int lane = 0; lane < kLanes; ++lane) {
    EXPECT_EQ(z.z[lane], lane * lane);
    EXPECT_EQ(z.x[lane], 0);
    EXPECT_EQ(dot(z, z)[lane], lane * lane * lane * lane);
  }
  EXPECT_EQ(sumOf(z.z), 0 + 1 + 4 + 9);
  EXPECT_EQ(largestOf(z.z), 9);
}

}  // namespace
}  // namespace careen
