#include "sound/film_clock.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

// Normal, at a tenth of the speed, frozen, and normal again.
const FilmClock kClock(TimeMap{.keys = {{0, 0.5}, {1, 1.5}, {2.00001, 1.6}, {3, 1.6}, {4, 2.6}}});

TEST(FilmClock, tellsWhenAMomentIsFirstSeen) {
  EXPECT_FALSE(kClock.filmTime(0.4));
  EXPECT_FALSE(kClock.filmTime(2.7));
  EXPECT_EQ(kClock.filmTime(0.5), 0);
  EXPECT_NEAR(*kClock.filmTime(1.25), 0.75, 1e-15);
  EXPECT_NEAR(*kClock.filmTime(1.55), 1.500005, 1e-12);
  EXPECT_EQ(kClock.filmTime(1.6), 2.00001) << "before it stands still";
  EXPECT_NEAR(*kClock.filmTime(2.1), 3.5, 1e-15);
}

TEST(FilmClock, everySampleIsInOneRunAndItsStepsAddUp) {
  for (const auto& [first, end] :
       {std::pair<std::int64_t, std::int64_t>(0, 200'000), {50'000, 96'001}, {7, 8}}) {
    std::int64_t next = first;
    double passed = 0;
    for (const SampleRun& run : kClock.runs(first, end)) {
      EXPECT_EQ(run.first, next);
      EXPECT_GT(run.end, run.first);
      next = run.end;
      passed += static_cast<double>(run.end - run.first) * run.sceneStep;
    }
    EXPECT_EQ(next, end);
    const auto scene = [](std::int64_t sample) {
      return kClock.sceneTime(static_cast<double>(sample) / kSampleRate);
    };
    EXPECT_NEAR(passed, scene(end) - scene(first), 1e-11);
  }
}

}  // namespace
}  // namespace careen
