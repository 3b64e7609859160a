#include "core/system/processor.h"

#include <gtest/gtest.h>
#include <sched.h>

namespace careen {
namespace {

// The machine may have one core only: then both halves of the test say the same.
TEST(Processor, hasAsManyUsableCoresAsTheProcessIsGiven) {
  cpu_set_t all;
  ASSERT_EQ(sched_getaffinity(0, sizeof(all), &all), 0);
  EXPECT_EQ(usableCores(), CPU_COUNT(&all));

  cpu_set_t one;
  CPU_ZERO(&one);
  for (int core = 0; CPU_COUNT(&one) == 0; ++core) {
    if (CPU_ISSET(core, &all)) {
      CPU_SET(core, &one);
    }
  }
  ASSERT_EQ(sched_setaffinity(0, sizeof(one), &one), 0);
  EXPECT_EQ(usableCores(), 1);
  ASSERT_EQ(sched_setaffinity(0, sizeof(all), &all), 0);
  EXPECT_EQ(usableCores(), CPU_COUNT(&all));
}

}  // namespace
}  // namespace careen
