#include "core/math/falling_bracket.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace careen {
namespace {

struct Search {
  FallingBracket bracket;
  int looks = 0;
};

// Looks until the ends are `width` apart; fails where a look is not between them.
Search searched(FallingBracket bracket, double width, const std::function<double(double)>& function) {
  Search search{bracket};
  FallingBracket& at = search.bracket;
  while (at.width() > width && search.looks < 200) {
    const double next = at.next(width / 2);
    EXPECT_GT(next, at.low);
    EXPECT_LT(next, at.high);
    at.add(next, function(next));
    ++search.looks;
  }
  EXPECT_GE(at.valueLow, 0);
  EXPECT_LT(at.valueHigh, 0);
  return search;
}

// By hand: from 3 at 0 to −1 at 4 the chord falls through zero at 3.
TEST(FallingBracket, looksFirstWhereTheChordFallsThroughZero) {
  FallingBracket bracket{.low = 0, .high = 4, .valueLow = 3, .valueHigh = -1};
  EXPECT_EQ(bracket.next(0), 3);
  bracket.add(3, -1);
  EXPECT_EQ(bracket.high, 3);
  EXPECT_EQ(bracket.valueHigh, -1);
  bracket.add(1, 2);
  EXPECT_EQ(bracket.width(), 2);
}

// By hand: the parabola x = −y + y²/16 has its root at 0 and passes through y = 4, 1, −4 at x = −3,
// −15/16, 5.
TEST(FallingBracket, looksWhereTheParabolaThroughThreePointsHasItsRoot) {
  FallingBracket bracket{.low = -3, .high = 5, .valueLow = 4, .valueHigh = -4};
  bracket.add(-0.9375, 1);
  EXPECT_NEAR(bracket.next(0), 0, 1e-15);
}

TEST(FallingBracket, comesToRootsOfSmoothFunctionsInFewLooks) {
  const double width = 0x1p-48;
  const Search crooked = searched({.low = 0, .high = 2, .valueLow = 1, .valueHigh = -31}, width,
                                  [](double x) { return 1 - x * x * x * x * x; });
  EXPECT_NEAR(crooked.bracket.low, 1, 0x1p-45);
  EXPECT_LE(crooked.looks, 14);  // measured 11
  const Search early = searched({.low = 0, .high = 1, .valueLow = 1e-9, .valueHigh = -1 + 1e-9}, width,
                                [](double x) { return 1e-9 - x * x; });
  EXPECT_NEAR(early.bracket.low, std::sqrt(1e-9), 1e-14);
  EXPECT_LE(early.looks, 26);  // measured 22
}

// A flat stretch and a step: no interpolation helps, halving does.
TEST(FallingBracket, halvesWhereNothingElseHelps) {
  const Search step = searched({.low = 0, .high = 1, .valueLow = 1, .valueHigh = -1e-30}, 0x1p-48,
                               [](double x) { return x < 0.3 ? 1 : -1e-30; });
  EXPECT_NEAR(step.bracket.high, 0.3, 0x1p-46);
  EXPECT_LE(step.looks, 60);  // measured 49
}

}  // namespace
}  // namespace careen
