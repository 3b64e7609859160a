#include "image/srgb.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

TEST(Srgb, comesBackToTheSameValue) {
  const SrgbTables& tables = SrgbTables::get();
  for (int value = 0; value < 256; ++value) {
    const auto encoded = static_cast<std::uint8_t>(value);
    EXPECT_EQ(tables.encoded(tables.linear(encoded)), value);
  }
}

// IEC 61966-2-1 at a few points: half of the light is code 188 (187.5), code 128 is 0.2159 of the light.
TEST(Srgb, isThatOfTheStandard) {
  const SrgbTables& tables = SrgbTables::get();
  EXPECT_EQ(tables.linear(0), 0);
  EXPECT_EQ(tables.linear(255), 65535);
  EXPECT_EQ(tables.encoded(32768), 188);
  EXPECT_NEAR(tables.linear(128) / 65535.0, 0.21586, 1e-5);
  EXPECT_NEAR(tables.linear(5) / 65535.0, 5 / 255.0 / 12.92, 1e-5);
}

}  // namespace
}  // namespace careen
