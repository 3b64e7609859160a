#include "audit/least_of_late.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

// Of the last second, and of one value before: that of 0 s counts until the one after it is a second old.
TEST(LeastOfLate, forgetsWhatIsTooOld) {
  LeastOfLate late(1);
  EXPECT_EQ(late.with(0, 3), 3);
  EXPECT_EQ(late.with(0.5, 5), 3);
  EXPECT_EQ(late.with(1.4, 7), 3);
  EXPECT_EQ(late.with(1.6, 6), 5);
  EXPECT_EQ(late.with(3, 9), 6);
  EXPECT_EQ(late.with(3.1, 1), 1);
}

TEST(LeastOfLate, isShiftedAsAWhole) {
  LeastOfLate late(1);
  late.with(0, 3);
  late.with(0.5, 5);
  late.shift(-2);
  EXPECT_EQ(late.with(0.6, 4), 1);
  EXPECT_EQ(late.with(1.55, 9), 3);
}

}  // namespace
}  // namespace careen
