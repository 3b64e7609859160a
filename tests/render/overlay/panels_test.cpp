// The words and values of panels; how they are laid out is tested through overlays.
#include <gtest/gtest.h>

#include <cmath>

#include "render/overlay/frame.h"

namespace careen {
namespace {

TEST(OverlayPanels, tellTimeInHoursMinutesSecondsAndThousandths) {
  EXPECT_EQ(timeCode(0), "00:00:00.000");
  EXPECT_EQ(timeCode(1.234), "00:00:01.234");
  EXPECT_EQ(timeCode(59.9996), "00:01:00.000");
  EXPECT_EQ(timeCode(3600 + 2 * 60 + 3.0456), "01:02:03.046");
  EXPECT_EQ(timeCode(100 * 3600), "100:00:00.000");
}

// At most 0.6 of the largest and more than 0.6/2.5 of it, and 1, 2 or 5 times a power of ten.
TEST(OverlayPanels, valuesOfTheLegendAreRound) {
  for (double largest = 1e-6; largest < 1e6; largest *= 1.003) {
    const double value = roundValue(largest);
    EXPECT_LE(value, 0.6 * largest * (1 + 1e-15));
    EXPECT_GT(value, 0.6 / 2.5 * largest);
    const double digit = value / std::pow(10, std::floor(std::log10(value * (1 + 1e-12))));
    EXPECT_TRUE(std::fabs(digit - 1) < 1e-12 || std::fabs(digit - 2) < 1e-12 || std::fabs(digit - 5) < 1e-12)
        << value;
  }
}

}  // namespace
}  // namespace careen
