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

// Movable bodies with rows at 0, ½, 1 … and one with rows between as well.
Trajectory withRows(std::size_t rows) {
  Trajectory run;
  run.settings.duration = 0.5 * static_cast<double>(rows);
  for (const std::size_t times : {std::size_t{1}, std::size_t{2}}) {
    run.world.bodies.push_back({.name = "b",
                                .halfExtents = Vec3::Ones(),
                                .mass = solidBox(Vec3::Ones(), 1),
                                .material = {},
                                .initial = {}});
    Track& track = run.tracks.emplace_back();
    for (std::size_t k = 0; k < times * rows; ++k) {
      track.segments.open().push_back(
          {.start = 0.5 * static_cast<double>(k) / static_cast<double>(times), .motion = Rest{}});
    }
  }
  return run;
}

TEST(Moments, ofATableAreTheRowsThatAllBoxesHave) {
  EXPECT_EQ(momentsOfRows(withRows(4), 100), (std::vector<double>{0, 0.5, 1, 1.5, 2}));
  const std::vector<double> few = momentsOfRows(withRows(1000), 10);
  EXPECT_LE(few.size(), 12U);
  EXPECT_GE(few.size(), 10U);
  EXPECT_EQ(few.front(), 0);
  EXPECT_EQ(few.back(), 500);
  for (const double moment : few) {
    EXPECT_EQ(moment * 2, std::floor(moment * 2));
  }
}

}  // namespace
}  // namespace careen
