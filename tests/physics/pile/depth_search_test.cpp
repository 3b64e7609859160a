#include "physics/pile/depth_search.h"

#include <gtest/gtest.h>

#include <cmath>

namespace careen {
namespace {

// Narrow dips at places that no halving hits: found wherever they are, as no gap changes faster than
// `motion`.
TEST(DepthSearch, findsDipsOfNoMoreThanTheMotionAllows) {
  constexpr double kMotion = 0.02;
  const DepthSearch search{.motion = kMotion, .deep = 1e-3, .swing = 2e-4, .shortest = 1e-3};
  for (int k = 1; k < 200; ++k) {
    const double at = k / 200.3;
    const auto gapAt = [&](double part) { return kMotion * std::fabs(part - at) - 1.5e-3; };
    const double deepest = searchDepth(search, gapAt, gapAt(0), gapAt(1));
    EXPECT_LE(deepest, 1.5e-3);
    EXPECT_GT(deepest, 1.4e-3) << at;
  }
}

// What cannot be deep is looked at nowhere between, nor what hardly moves; what is deep at the ends is known.
TEST(DepthSearch, looksOnlyWhereItMayBeDeep) {
  int looks = 0;
  const auto gapAt = [&](double) {
    ++looks;
    return 0.5;
  };
  EXPECT_EQ(searchDepth({.motion = 1, .deep = 0.1, .swing = 0.01, .shortest = 0.1}, gapAt, 0.4, 0.5), 0);
  EXPECT_EQ(searchDepth({.motion = 1, .deep = 0.1, .swing = 2, .shortest = 0.1}, gapAt, -0.2, -0.2), 0);
  EXPECT_EQ(looks, 0);
  EXPECT_EQ(searchDepth({.motion = 1, .deep = 0.1, .swing = 0.01, .shortest = 0.1}, gapAt, 0.3, 0.4), 0);
  EXPECT_EQ(looks, 1);
}

}  // namespace
}  // namespace careen
