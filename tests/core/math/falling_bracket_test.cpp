#include "core/math/falling_bracket.h"

#include <cmath>

#include <gtest/gtest.h>

namespace careen {
namespace {

// By hand: from 3 at 0 to −1 at 4 the chord falls through zero at 3. The end that stays counts half: from 1.5
// at 0 to −1 at 3 it does so at 1.8.
TEST(FallingBracket, cutsWhereTheChordFallsThroughZero) {
  FallingBracket bracket{.low = 0, .high = 4, .valueLow = 3, .valueHigh = -1};
  EXPECT_EQ(bracket.cut(), 3);
  bracket.moveHigh(3, -1);
  EXPECT_DOUBLE_EQ(bracket.cut(), 1.8);
  bracket.moveLow(1, 2);
  EXPECT_EQ(bracket.valueHigh, -0.5);
  EXPECT_EQ(bracket.width(), 2);
}

// 1 − x⁵ on [0, 2] is so crooked that plain regula falsi, whose end at 2 stays, is still off by 0.37 after
// twelve cuts.
TEST(FallingBracket, comesToTheRootOfACrookedFunction) {
  FallingBracket bracket{.low = 0, .high = 2, .valueLow = 1, .valueHigh = -31};
  double at = 0;
  for (int k = 0; k < 12; ++k) {
    at = bracket.cut();
    const double value = 1 - at * at * at * at * at;
    if (value < 0) {
      bracket.moveHigh(at, value);
    } else {
      bracket.moveLow(at, value);
    }
  }
  EXPECT_LT(std::fabs(at - 1), 2e-3);  // measured 7.1e-4
}

}  // namespace
}  // namespace careen
