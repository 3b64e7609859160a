#include "physics/exact/event_queue.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>

#include "core/error.h"

namespace careen {
namespace {

// The last of many hops is as exact as the first, though the clock by then shows no digit of it.
TEST(EventQueue, clockKeepsTheDigitsOfShortHopsLateInARun) {
  Instant now(0);
  double hop = 0.9;
  double sum = 0;
  for (int k = 0; k < 2000; ++k) {
    const Instant next = instantAfter(now, hop);
    ASSERT_EQ(secondsBetween(now, next), hop) << k;
    ASSERT_EQ(next.hi, next.hi + next.lo) << k;
    sum += secondsBetween(now, next);
    now = next;
    hop *= 0.99;
  }
  EXPECT_NEAR(now.hi, 0.9 / (1 - 0.99), 0.9e-6);
  EXPECT_NEAR(now.hi, sum, 1e-12);
}

TEST(EventQueue, handsOutTheEarliestAndOnlyTheLatestWordOfEachBody) {
  EventQueue queue(3);
  queue.set({.time = 2, .body = 0});
  queue.set({.time = Instant(1, 0x1p-60), .body = 1});
  queue.set({.time = 1, .body = 2});
  queue.set({.time = 3, .body = 0});
  EXPECT_EQ(queue.next()->body, 2);
  EXPECT_EQ(queue.next()->body, 1);
  const std::optional<Event> last = queue.next();
  ASSERT_TRUE(last);
  EXPECT_EQ(last->time.hi, 3);
  EXPECT_FALSE(queue.next());
}

// Such an event, in a heap, puts all others out of order: a crowd's step ended after later events, and its
// members were recorded metres away.
TEST(EventQueue, refusesWhatIsAtNoMoment) {
  EventQueue queue(1);
  EXPECT_THROW(queue.set({.time = std::numeric_limits<double>::quiet_NaN(), .body = 0}), NumericalError);
  EXPECT_FALSE(queue.next());
}

TEST(EventQueue, forgetsWhatIsCleared) {
  EventQueue queue(1);
  queue.set({.time = 2, .body = 0});
  queue.clear(0);
  EXPECT_FALSE(queue.next());
}

}  // namespace
}  // namespace careen
