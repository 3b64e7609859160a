#include "core/number_range.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace careen {
namespace {

TEST(NumberRange, countsFromTheFirstToTheLast) {
  EXPECT_EQ(numbersOfRange("0:2:0.5"), (std::vector<double>{0, 0.5, 1, 1.5, 2}));
  EXPECT_EQ(numbersOfRange("1:1.9:0.4"), (std::vector<double>{1, 1.4, 1.8}));
  EXPECT_EQ(numbersOfRange("3:3:1"), (std::vector<double>{3}));
  EXPECT_EQ(numbersOfRange("1.5"), (std::vector<double>{1.5}));
  EXPECT_EQ(numbersOfRange("0"), (std::vector<double>{0}));
}

// 0.3 / 0.1 is 2.9999999999999996.
TEST(NumberRange, hasItsLastThoughDecimalsAreNotExact) {
  EXPECT_EQ(numbersOfRange("0:0.3:0.1").size(), 4U);
  EXPECT_EQ(numbersOfRange("0:2:0.1").size(), 21U);
  EXPECT_EQ(numbersOfRange("0:2:0.1").back(), 2);
}

TEST(NumberRange, refusesWhatIsNone) {
  for (const char* text : {"",
                           ":",
                           "x",
                           "-1",
                           "nan",
                           "inf",
                           "1 ",
                           "0:2",
                           "0:2:0",
                           "0:2:-1",
                           "2:0:0.1",
                           "-1:2:0.1",
                           "0:2:0.1:3",
                           "0:x:1",
                           "0:2:0.001",
                           "0:inf:1",
                           "0:1e300:1e-300",
                           "0:1:1e-320",
                           "nan:2:1",
                           "0:2:"}) {
    EXPECT_THROW(numbersOfRange(text), InputError) << text;
  }
}

}  // namespace
}  // namespace careen
