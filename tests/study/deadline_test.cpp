#include "study/deadline.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace careen {
namespace {

using Clock = std::chrono::steady_clock;

// Computes until then.
double secondsUntilStopped(const std::stop_token& token) {
  const double start = coreSeconds();
  while (!token.stop_requested() && coreSeconds() < start + 20) {
  }
  return coreSeconds() - start;
}

TEST(Deadline, firesWhenTheTimeIsUpAndNotBefore) {
  const Deadline deadline(0.1, {});
  EXPECT_FALSE(deadline.token().stop_requested());
  const double seconds = secondsUntilStopped(deadline.token());
  EXPECT_GE(seconds, 0.09);
  EXPECT_LT(seconds, 20);
}

// As if another program had the core meanwhile.
TEST(Deadline, doesNotCountTimeInWhichNothingIsComputed) {
  const Deadline deadline(0.1, {});
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_FALSE(deadline.token().stop_requested());
}

TEST(Deadline, firesWhenTheOuterOneDoes) {
  std::stop_source outer;
  const Deadline deadline(60, outer.get_token());
  EXPECT_FALSE(deadline.token().stop_requested());
  outer.request_stop();
  EXPECT_TRUE(deadline.token().stop_requested());
}

TEST(Deadline, leavesTheOuterOneAlone) {
  const std::stop_source outer;
  const Deadline deadline(0, outer.get_token());
  EXPECT_LT(secondsUntilStopped(deadline.token()), 20);
  EXPECT_FALSE(outer.stop_requested());
}

TEST(Deadline, isNotWaitedForOnceItIsNotNeeded) {
  const Clock::time_point start = Clock::now();
  { const Deadline deadline(60, {}); }
  EXPECT_LT(std::chrono::duration<double>(Clock::now() - start).count(), 30);
}

}  // namespace
}  // namespace careen
