#include "compare/difference_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

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

// 16 x 16: stripes of two of eight pixels, and an outline of one.
TEST(DifferenceImage, ignoredPixelsAreStripedAndOutlined) {
  PixelMask mask{.width = 16, .ignored = std::vector<bool>(256)};
  for (std::size_t i = 0; i < 256; ++i) {
    mask.ignored[i] = i % 16 >= 4;
  }
  const Picture image = ignoredImage(mask);
  ASSERT_EQ(image.width, 16);
  ASSERT_EQ(image.height, 16);
  const auto isMarked = [&image](std::size_t x, std::size_t y) {
    const auto at = image.rgb.begin() + static_cast<std::ptrdiff_t>(3 * (16 * y + x));
    const bool black = std::all_of(at, at + 3, [](int sample) { return sample == 0; });
    EXPECT_TRUE(black || std::equal(at, at + 3, kMarkColor.begin()));
    return !black;
  };
  EXPECT_FALSE(isMarked(3, 5));  // counts; else it would be in a stripe
  EXPECT_TRUE(isMarked(4, 0));   // outline
  EXPECT_FALSE(isMarked(5, 0));
  EXPECT_TRUE(isMarked(8, 0));
  EXPECT_TRUE(isMarked(9, 0));
  EXPECT_FALSE(isMarked(10, 0));
  EXPECT_FALSE(isMarked(15, 0));  // the picture's border is no outline
  EXPECT_TRUE(isMarked(15, 1));
}

}  // namespace
}  // namespace careen
