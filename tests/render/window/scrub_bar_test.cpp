#include "render/window/scrub_bar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace careen {
namespace {

constexpr int kWidth = 101;
constexpr int kHeight = 7;

Picture somePicture() {
  Picture picture{.width = kWidth, .height = kHeight, .rgb = {}};
  for (int i = 0; i < kWidth * kHeight * 3; ++i) {
    picture.rgb.push_back(static_cast<std::uint8_t>(i * 37));
  }
  return picture;
}

std::array<int, 3> middlePixel(const Picture& picture, int x) {
  const std::size_t at =
      (kHeight + kScrubBarHeight / 2) * picture.rowBytes() + 3 * static_cast<std::size_t>(x);
  return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

TEST(ScrubBar, hidesNothingOfThePicture) {
  const Picture picture = somePicture();
  const Picture whole = withScrubBar(picture, 0.3);
  EXPECT_EQ(whole.width, kWidth);
  EXPECT_EQ(whole.height, kHeight + kScrubBarHeight);
  ASSERT_EQ(whole.rgb.size(), whole.rowBytes() * (kHeight + kScrubBarHeight));
  EXPECT_TRUE(std::equal(picture.rgb.begin(), picture.rgb.end(), whole.rgb.begin()));
}

// What is over is coloured otherwise than what is to come, and the knob stands between them, at a place that
// stands for where the film is.
TEST(ScrubBar, showsWhereTheFilmIs) {
  for (const double part : {0.0, 0.25, 0.5, 1.0}) {
    const Picture whole = withScrubBar(somePicture(), part);
    int knob = 0;
    while (middlePixel(whole, knob) != std::array<int, 3>{242, 238, 228} && knob < kWidth - 1) {
      ++knob;
    }
    EXPECT_NEAR(partOnScrubBar(knob + 3.5, kWidth), part, 0.01);
  }
  const Picture half = withScrubBar(somePicture(), 0.5);
  EXPECT_EQ(middlePixel(half, 10), middlePixel(half, 40));
  EXPECT_EQ(middlePixel(half, 60), middlePixel(half, 90));
  EXPECT_NE(middlePixel(half, 10), middlePixel(half, 90));
}

TEST(ScrubBar, everyPlaceOnItIsAPartOfTheFilm) {
  EXPECT_EQ(partOnScrubBar(-50, kWidth), 0);
  EXPECT_EQ(partOnScrubBar(0, kWidth), 0);
  EXPECT_DOUBLE_EQ(partOnScrubBar(50, kWidth), 0.5);
  EXPECT_EQ(partOnScrubBar(100, kWidth), 1);
  EXPECT_EQ(partOnScrubBar(500, kWidth), 1);
}

TEST(ScrubBar, fitsUnderANarrowPicture) {
  const Picture dot{.width = 1, .height = 1, .rgb = {1, 2, 3}};
  EXPECT_EQ(withScrubBar(dot, 1).rgb.size(), 3U * (1 + kScrubBarHeight));
  EXPECT_EQ(partOnScrubBar(0.5, 1), 0);
}

}  // namespace
}  // namespace careen
