#include "physics/motion/run_progress.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "physics/world/body.h"

namespace careen {
namespace {

RunForecast forecastFrom(const std::vector<RunMark>& marks) {
  RunForecast forecast;
  for (const RunMark& mark : marks) {
    forecast.add(mark);
  }
  return forecast;
}

TEST(RunForecast, goesOnAtASteadyRate) {
  const RunForecast forecast = forecastFrom({{1, 2, 100}, {2, 4, 200}, {3, 6, 300}, {4, 8, 400}});
  EXPECT_DOUBLE_EQ(forecast.secondsUntil(20).value(), 6);  // 2 simulated seconds a second
  EXPECT_DOUBLE_EQ(forecast.recordsAt(20), 1000);          // 50 a simulated second
  EXPECT_DOUBLE_EQ(forecast.timeOf(1000), 20);
}

// Ten simulated seconds in the first, then one in each: the first is forgotten.
TEST(RunForecast, isOfLate) {
  const RunForecast forecast = forecastFrom({{1, 10, 0}, {2, 11, 30}, {3, 12, 60}});
  EXPECT_DOUBLE_EQ(forecast.secondsUntil(20).value(), 8);
  EXPECT_DOUBLE_EQ(forecast.recordsAt(20), 60 + 8 * 30);
}

TEST(RunForecast, knowsNothingWhereNoTimePasses) {
  EXPECT_FALSE(RunForecast().secondsUntil(1).has_value());
  EXPECT_FALSE(forecastFrom({{1, 0, 500}}).secondsUntil(1).has_value());
  EXPECT_EQ(forecastFrom({{1, 1, 0}}).timeOf(10), HUGE_VAL);
}

TEST(RunForecast, exceedsOnlyWhatHalfItsRateExceedsToo) {
  EXPECT_FALSE(forecastFrom({{1, 0.01, 99}}).exceeds(1000, 10));  // less than a tenth of them
  EXPECT_TRUE(forecastFrom({{1, 0.01, 100}}).exceeds(1000, 10));
  EXPECT_FALSE(forecastFrom({{1, 1, 100}}).exceeds(1000, 10));  // just fits
  EXPECT_FALSE(forecastFrom({{1, 1, 181}}).exceeds(1000, 10));  // half of 9 · 181 are 814.5, 819 are left
  EXPECT_TRUE(forecastFrom({{1, 1, 182}}).exceeds(1000, 10));   // 819, and 818
}

class CountedRecords : public Recorder {
 public:
  void moves(BodyIndex /*body*/, double time, const Motion& /*motion*/) override { times.push_back(time); }
  void strikes(const Impact& impact) override { times.push_back(impact.time); }
  void reaches(double time) override { reached = time; }
  bool hasEnough() const override { return reached > 4; }
  std::vector<double> times;
  double reached = 0;  // [s]
};

// Two boxes that can move, and one that cannot.
World twoOfThree() {
  World world;
  world.bodies.resize(3);
  for (Body& body : world.bodies) {
    body.mass.inverseMass = 1;
  }
  world.bodies[2].mass.inverseMass = 0;
  return world;
}

TEST(ProgressRecorder, handsAllOnAndTellsWhatTheBoxesDo) {
  CountedRecords kept;
  std::vector<RunProgress> told;
  const RunCallback tell = [&](const RunProgress& now) { told.push_back(now); };
  const World world = twoOfThree();
  ProgressRecorder recorder(world, 5, kept, tell);
  recorder.moves({2}, 0, Rest{});
  recorder.moves({0}, 0, Flight{});
  recorder.moves({1}, 0, Flight{});
  recorder.strikes({.time = 1, .a = {0}});
  recorder.moves({0}, 1, ContactStep{});
  recorder.moves({0}, 2, CrowdStep{});
  recorder.moves({1}, 3, Rest{});
  recorder.reaches(3);
  EXPECT_EQ(kept.reached, 3);
  EXPECT_FALSE(recorder.hasEnough());
  recorder.reaches(4.5);
  EXPECT_TRUE(recorder.hasEnough());
  recorder.finish();
  EXPECT_EQ(kept.times, (std::vector<double>{0, 0, 0, 1, 1, 2, 3}));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_TRUE(told[0].isOver);
  EXPECT_EQ(told[0].now.time, 5);
  EXPECT_EQ(told[0].duration, 5);
  EXPECT_EQ(told[0].now.records, 7U);
  EXPECT_EQ(told[0].impacts, 1U);
  EXPECT_EQ(told[0].flying, 0U);
  EXPECT_EQ(told[0].touching, 1U);
  EXPECT_EQ(told[0].resting, 1U);
}

// Events that take 30 ms, after a thousand that take none: some tell, most not.
TEST(ProgressRecorder, tellsEveryTenthOfASecond) {
  CountedRecords kept;
  std::vector<double> told;
  const RunCallback tell = [&](const RunProgress& now) { told.push_back(now.now.time); };
  const World world = twoOfThree();
  const Clock::time_point begun = Clock::now();
  ProgressRecorder recorder(world, 5, kept, tell);
  for (int i = 0; i < 1000; ++i) {
    recorder.reaches(1);
  }
  for (int i = 0; i < 30; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    recorder.reaches(2 + 0.01 * i);
  }
  ASSERT_GE(told.size(), 2U);
  EXPECT_LE(static_cast<double>(told.size()), secondsSince(begun) / 0.1);
  EXPECT_GT(told.back(), 2.2);
}

}  // namespace
}  // namespace careen
