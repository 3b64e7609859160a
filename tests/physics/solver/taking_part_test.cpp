#include "physics/solver/taking_part.h"

#include <gtest/gtest.h>

#include <vector>

namespace careen {
namespace {

using Takes = std::vector<char>;

TEST(TakingPart, addsWhatIsEnteredUntilNothingIs) {
  // Contact 1 is entered as long as it takes no part; 2 once 1 does; 3 never.
  Takes takes{1, 0, 0, 0};
  std::vector<Takes> solved;
  const bool found = solveWithTakingPart(
      takes,
      [&](const Takes& given) {
        solved.push_back(given);
        return true;
      },
      [&](std::size_t c) { return c == 1 || (c == 2 && solved.back()[1] != 0); });
  EXPECT_TRUE(found);
  EXPECT_EQ(takes, (Takes{1, 1, 1, 0}));
  EXPECT_EQ(solved, (std::vector<Takes>{{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 1, 1, 0}}));
}

TEST(TakingPart, endsWhereNoMotionIsFound) {
  Takes takes{1, 0};
  int solves = 0;
  const auto enters = [](std::size_t) { return true; };
  EXPECT_FALSE(solveWithTakingPart(
      takes, [&](const Takes&) { return ++solves < 2; }, enters));
  EXPECT_EQ(solves, 2);
}

}  // namespace
}  // namespace careen
