#include "compare/difference_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/input_error.h"

namespace careen {
namespace {

using Bytes = std::vector<std::uint8_t>;

DeepPicture row(const Bytes& samples, int channels = 3) {
  return {.width = static_cast<int>(samples.size()) / channels,
          .height = 1,
          .channels = channels,
          .samples8 = samples,
          .samples16 = {}};
}

TEST(DifferenceImage, isBlackWhereNothingDiffersAndTheAbsoluteDifferenceElsewhere) {
  const DeepPicture expected = row({10, 20, 30, 200, 0, 5});
  const DeepPicture actual = row({10, 20, 30, 190, 7, 5});
  EXPECT_EQ(differenceImage(expected, actual, 1).rgb, (Bytes{0, 0, 0, 10, 7, 0}));
  EXPECT_EQ(differenceImage(actual, expected, 4).rgb, (Bytes{0, 0, 0, 40, 28, 0}));
  EXPECT_EQ(differenceImage(expected, actual, 32).rgb, (Bytes{0, 0, 0, 255, 224, 0}));
}

TEST(DifferenceImage, seesOneOf65535AndAlpha) {
  DeepPicture expected{
      .width = 1, .height = 1, .deep = true, .samples8 = {}, .samples16 = {1000, 2000, 3000}};
  DeepPicture actual = expected;
  actual.samples16[1] += 1;
  EXPECT_EQ(amplificationOf(expected, actual), 32768);
  EXPECT_EQ(differenceImage(expected, actual, 32768).rgb, (Bytes{0, 128, 0}));
  EXPECT_EQ(differenceImage(row({9, 9, 9, 250}, 4), row({9, 9, 19, 255}, 4), 1).rgb, (Bytes{5, 5, 15}));
  EXPECT_EQ(differenceImage(row({9, 9, 9}), row({9, 9, 9, 254}, 4), 1).rgb, (Bytes{1, 1, 1}));
}

TEST(DifferenceImage, isAmplifiedAsFarAsNothingMuchIsCutOff) {
  EXPECT_EQ(amplificationOf(row({5, 5, 5}), row({5, 5, 5})), 1);
  EXPECT_EQ(amplificationOf(row({0, 0, 0}), row({0, 255, 0})), 1);
  EXPECT_EQ(amplificationOf(row({0, 0, 0}), row({0, 7, 3})), 32);  // 224; 64 would be 448
  // A hundred pixels are off by 2 and one by 200: that one may be clipped, two of them may not.
  Bytes off(303, 2);
  std::fill(off.begin(), off.begin() + 3, std::uint8_t{200});
  EXPECT_EQ(amplificationOf(row(Bytes(303, 0)), row(off)), 64);
  std::fill(off.begin(), off.begin() + 6, std::uint8_t{200});
  EXPECT_EQ(amplificationOf(row(Bytes(303, 0)), row(off)), 1);
}

TEST(DifferenceImage, sizesMustBeTheSame) {
  EXPECT_EQ(inputErrorOf([] {
              differenceImage(row({1, 2, 3}), row({1, 2, 3, 4, 5, 6}), 1);
            }),
            "found a picture of 2x1 pixels, expected one of 1x1");
}

}  // namespace
}  // namespace careen
