#include "core/system/clock.h"

#include <gtest/gtest.h>

#include <thread>

namespace careen {
namespace {

TEST(Clock, secondsPassAndNeverBackwards) {
  const Clock::time_point begun = Clock::now();
  const double atOnce = secondsSince(begun);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_GE(atOnce, 0.0);
  EXPECT_GE(secondsSince(begun), atOnce + 0.020);
}

}  // namespace
}  // namespace careen
