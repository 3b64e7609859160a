#include "core/brief.h"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

namespace careen {
namespace {

TEST(Brief, givesFourSignificantDigitsUnlessAskedForOthers) {
  EXPECT_EQ(brief(0), "0");
  EXPECT_EQ(brief(-2.5), "-2.5");
  EXPECT_EQ(brief(0.082114), "0.08211");
  EXPECT_EQ(brief(123456), "1.235e+05");
  EXPECT_EQ(brief(1e-9), "1e-09");
  EXPECT_EQ(brief(2.0 / 3, 2), "0.67");
  EXPECT_EQ(brief(2.0 / 3, 7), "0.6666667");
}

TEST(Brief, knowsWhatIsNotFinite) {
  EXPECT_EQ(brief(HUGE_VAL), "inf");
  EXPECT_EQ(brief(-HUGE_VAL), "-inf");
  EXPECT_EQ(brief(std::nan("")), "nan");
}

double parsed(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  EXPECT_EQ(error, std::errc());
  EXPECT_EQ(end, text.data() + text.size());
  return value;
}

// Every exponent, subnormal numbers too.
TEST(Brief, inFullBringsTheSameBitsBack) {
  std::mt19937_64 random(3);
  for (int k = 0; k < 20000; ++k) {
    const std::uint64_t bits = random();
    if ((bits >> 52U & 0x7ffU) != 0x7ff) {  // finite
      EXPECT_EQ(std::bit_cast<std::uint64_t>(parsed(inFull(std::bit_cast<double>(bits)))), bits);
    }
  }
  EXPECT_EQ(inFull(0.1), "0.1");
  EXPECT_EQ(inFull(-0.0), "-0");
  EXPECT_EQ(inFull(-2.2250738585072014e-308).size(), 24U);  // the longest there is
}

TEST(Brief, inFullTellsNeighboursApart) {
  const double value = 9.81;
  EXPECT_NE(inFull(std::nextafter(value, 10)), inFull(value));
  EXPECT_EQ(brief(std::nextafter(value, 10)), brief(value));
}

}  // namespace
}  // namespace careen
