#include "stage/time_map.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace careen {
namespace {

// As it was for a second, the impact at 1/20 speed for two, a freeze frame, and on.
const TimeMap kImpact = {.keys = {{0, 0}, {1.1, 1.1}, {3.1, 1.2}, {3.7, 1.2}, {5.7, 3.2}}};

TEST(TimeMap, isExactAtKeys) {
  for (const TimeKey& key : kImpact.keys) {
    EXPECT_EQ(kImpact.sceneTime(key.film), key.scene);
  }
}

TEST(TimeMap, isLinearBetweenThem) {
  EXPECT_DOUBLE_EQ(kImpact.sceneTime(0.3), 0.3);
  EXPECT_DOUBLE_EQ(kImpact.sceneTime(2.1), 1.15);
  EXPECT_NEAR(kImpact.sceneTime(2.3) - kImpact.sceneTime(2.1), 0.2 / 20, 1e-15);
  EXPECT_DOUBLE_EQ(kImpact.sceneTime(4.7), 2.2);
}

TEST(TimeMap, freezesWhereSceneTimesAreEqual) {
  for (const double film : {3.1, 3.2, 3.5, 3.7}) {
    EXPECT_EQ(kImpact.sceneTime(film), 1.2);
  }
}

TEST(TimeMap, neverRunsBackwards) {
  double last = 0;
  for (int i = 0; i <= 60'000; ++i) {
    const double now = kImpact.sceneTime(i * 1e-4);
    EXPECT_GE(now, last) << i;
    last = now;
  }
}

TEST(TimeMap, standsStillBeyondItsEnds) {
  EXPECT_EQ(kImpact.sceneTime(-1), 0);
  EXPECT_EQ(kImpact.sceneTime(9), 3.2);
}

TEST(TimeMap, withoutKeysIsTheRunItself) {
  const TimeMap none;
  EXPECT_EQ(none.sceneTime(0.1), 0.1);
  const TimeMap run = none.within(4);
  EXPECT_EQ(run.duration(), 4);
  for (const double time : {0.0, 0.1, 1.0 / 3, 1001.0 / 24000, 4.0}) {
    EXPECT_EQ(run.sceneTime(time), time);
  }
}

TEST(TimeMap, endsWithTheRun) {
  EXPECT_EQ(kImpact.within(10).duration(), 5.7);
  EXPECT_EQ(kImpact.within(3.2).duration(), 5.7);
  const TimeMap cut = kImpact.within(2.2);
  EXPECT_DOUBLE_EQ(cut.duration(), 4.7);
  EXPECT_EQ(cut.sceneTime(cut.duration()), 2.2);
  EXPECT_EQ(cut.sceneTime(3.3), 1.2);
  const TimeMap late = {.keys = {{0, 2}, {1, 3}}};
  EXPECT_THROW(late.within(2), InputError);
}

}  // namespace
}  // namespace careen
