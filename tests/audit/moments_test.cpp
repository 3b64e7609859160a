#include "audit/moments.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace careen {
namespace {

TEST(Moments, leaveNoLargeGapAndNeverRepeat) {
  for (const std::size_t count : {1U, 10U, 1000U}) {
    const std::vector<double> moments = goldenMoments(2, count);
    ASSERT_EQ(moments.size(), count + 2);
    EXPECT_EQ(moments.front(), 0);
    EXPECT_EQ(moments.back(), 2);
    for (std::size_t i = 1; i < moments.size(); ++i) {
      const double gap = moments[i] - moments[i - 1];
      EXPECT_GT(gap, 0);
      EXPECT_LT(
          gap,
          2 * 2.7 / static_cast<double>(count + 1));  // three-distance theorem: at most φ² times the mean
    }
  }
}

TEST(Moments, areNotThoseOfFramesOrSteps) {
  for (const double moment : goldenMoments(10, 500)) {
    const double frames = moment * 240;
    EXPECT_TRUE(moment == 0 || moment == 10 || std::abs(frames - std::round(frames)) > 1e-6) << moment;
  }
}

}  // namespace
}  // namespace careen
