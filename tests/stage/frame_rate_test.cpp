#include "stage/frame_rate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "support/input_error.h"

namespace careen {
namespace {

__extension__ typedef __int128 Wide;  // NOLINT(modernize-use-using)

// Whether no double is nearer to numerator/denominator than `value`, decided in integers: value is m·2⁻ˢ with
// an integer m of 53 bits, whose last bit is worth 2⁻ˢ.
bool isNearestTo(double value, std::int64_t numerator, std::int64_t denominator) {
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  const auto m = static_cast<Wide>(std::ldexp(fraction, 53));
  const int s = 53 - exponent;
  const Wide difference = (static_cast<Wide>(numerator) << s) - m * denominator;
  return 2 * (difference < 0 ? -difference : difference) <= denominator;
}

TEST(FrameRate, frameTimesAreTheExactQuotientsRoundedOnce) {
  for (const char* text :
       {"24", "25", "30", "60", "23.976", "29.97", "59.94", "119.88", "12.5", "1000", "0.001"}) {
    const FrameRate rate = parseFrameRate(text);
    for (std::int64_t frame = 1; frame <= 100'000; ++frame) {
      ASSERT_TRUE(isNearestTo(rate.frameTime(frame), frame * rate.denominator, rate.numerator))
          << text << " frame " << frame;
    }
    EXPECT_EQ(rate.frameTime(0), 0) << text;
    EXPECT_TRUE(
        isNearestTo(rate.frameTime(kMostFrames - 1), (kMostFrames - 1) * rate.denominator, rate.numerator));
  }
}

TEST(FrameRate, runningSumWouldMissTheFrameTimes) {
  const FrameRate rate = parseFrameRate("60");
  double sum = 0;
  for (int frame = 0; frame < 600; ++frame) {
    sum += 1.0 / 60;
  }
  EXPECT_EQ(rate.frameTime(600), 10);
  EXPECT_NE(sum, 10);
}

TEST(FrameRate, countsTheFramesBeforeTheEnd) {
  struct Case {
    const char* rate;
    double duration;
    std::int64_t frames;
  };
  for (const Case& c : std::vector<Case>{{"60", 10, 600},
                                         {"30", 4, 120},
                                         {"30", 0.1, 3},
                                         {"24", 10, 240},
                                         {"25", 10, 250},
                                         {"23.976", 10, 240},     // frame 239 is at 9.968 s
                                         {"23.976", 10.01, 240},  // frame 240 is at 10.01 s
                                         {"23.976", 10.011, 241},
                                         {"10", 0.3, 3},
                                         {"30", 0.0333333, 1},
                                         {"30", 1.0 / 30, 1},
                                         {"30", 0.0333334, 2},
                                         {"30", 1e-60, 1},
                                         {"30", 0, 0},
                                         {"30", -1, 0},
                                         {"30", std::numeric_limits<double>::quiet_NaN(), 0}}) {
    EXPECT_EQ(parseFrameRate(c.rate).frameCount(c.duration), c.frames) << c.rate << " for " << c.duration;
  }
}

TEST(FrameRate, everyCountAgreesWithTheTimes) {
  for (const char* text : {"24", "30", "60", "23.976", "59.94", "7.3"}) {
    const FrameRate rate = parseFrameRate(text);
    for (int thousandths = 1; thousandths < 20'000; thousandths += 7) {
      const double duration = thousandths / 1000.0;
      const std::int64_t count = rate.frameCount(duration);
      EXPECT_LT(rate.frameTime(count - 1), duration);
      EXPECT_GE(rate.frameTime(count), duration);
    }
  }
}

TEST(FrameRate, refusesFilmsWithoutEnd) {
  EXPECT_EQ(
      inputErrorOf([] { parseFrameRate("30").frameCount(1e60); }),
      "found a film longer than 1000000000 frames, expected a shorter duration or fewer frames per second");
}

TEST(FrameRate, readsRatiosDecimalsAndBroadcastRates) {
  const std::vector<std::pair<const char*, FrameRate>> cases = {
      {"30", {30, 1}},          {"60/2", {30, 1}},          {"24000/1001", {24000, 1001}},
      {"12.5", {25, 2}},        {"23.976", {24000, 1001}},  {"29.97", {30000, 1001}},
      {"59.94", {60000, 1001}}, {"119.88", {120000, 1001}}, {"23.976024", {24000, 1001}},
      {"23.98", {1199, 50}},    {"0.001", {1, 1000}},       {"100000", {100000, 1}},
      {"1e3", {1000, 1}}};
  for (const auto& [text, rate] : cases) {
    EXPECT_EQ(parseFrameRate(text), rate) << text << " gives " << parseFrameRate(text).text();
  }
  EXPECT_EQ(frameRateFrom(23.976).text(), "24000/1001");
  EXPECT_EQ(frameRateFrom(30).text(), "30");
  EXPECT_EQ(FrameRate().text(), "30");
}

TEST(FrameRate, refusesWhatIsNoRate) {
  for (const char* text : {"",
                           " ",
                           "fast",
                           "30fps",
                           "0",
                           "-30",
                           "1/0",
                           "0/1",
                           "-1/-2",
                           "1//2",
                           "30/",
                           "/30",
                           "nan",
                           "inf",
                           "1e400",
                           "0.0001",
                           "100001",
                           "1/2000000",
                           "9999999999999999999/1",
                           "+30",
                           " 30"}) {
    const std::string message = inputErrorOf([text] { parseFrameRate(text); });
    EXPECT_EQ(message.find("found "), 0) << text << ": " << message;
    EXPECT_NE(message.find(", expected a rate from 0.001 to 100000, such as 30, 12.5 or 24000/1001"),
              std::string::npos)
        << message;
  }
  EXPECT_EQ(
      inputErrorOf([] { frameRateFrom(0); }),
      "found 0 frames per second, expected a rate from 0.001 to 100000, such as 30, 12.5 or 24000/1001");
}

}  // namespace
}  // namespace careen
