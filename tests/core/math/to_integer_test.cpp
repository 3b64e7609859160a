#include "core/math/to_integer.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "support/without_traps.h"

namespace careen {
namespace {

TEST(ToInteger, dropsTheFraction) {
  EXPECT_EQ(toInteger<int>(2.9, -7), 2);
  EXPECT_EQ(toInteger<int>(-2.9, -7), -2);
  EXPECT_EQ(toInteger<std::int64_t>(0x1p62, std::int64_t{-7}), std::int64_t{1} << 62);
}

TEST(ToInteger, takesAllThatTheTypeHoldsAndNoMore) {
  EXPECT_EQ(toInteger<int>(2147483647.0, -7), std::numeric_limits<int>::max());
  EXPECT_EQ(toInteger<int>(-2147483648.0, -7), std::numeric_limits<int>::min());
  EXPECT_EQ(toInteger<int>(2147483648.0, -7), -7);
  EXPECT_EQ(toInteger<int>(-2147483649.0, -7), -7);
  EXPECT_EQ(toInteger<std::int64_t>(0x1p63, std::int64_t{-7}), -7);
  EXPECT_EQ(toInteger<std::int64_t>(-0x1p63, std::int64_t{-7}), std::numeric_limits<std::int64_t>::min());
}

TEST(ToInteger, hasAnAnswerForWhatIsNoNumber) {
  const WithoutTraps quiet;
  EXPECT_EQ(toInteger<int>(std::numeric_limits<double>::quiet_NaN(), -7), -7);
  EXPECT_EQ(toInteger<int>(std::numeric_limits<double>::infinity(), -7), -7);
  EXPECT_EQ(toInteger<int>(-std::numeric_limits<double>::infinity(), -7), -7);
}

}  // namespace
}  // namespace careen
