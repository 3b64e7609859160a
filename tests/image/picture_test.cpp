#include "image/picture.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(Picture, alphaStandsBehindTheColourOfItsPixel) {
  const Picture picture{.width = 2, .height = 1, .rgb = {1, 2, 3, 4, 5, 6}, .alpha = {7, 8}};
  EXPECT_EQ(rgbaOf(picture), (Bytes{1, 2, 3, 7, 4, 5, 6, 8}));
}

TEST(Picture, withoutAlphaIsOpaque) {
  const Picture picture{.width = 2, .height = 1, .rgb = {1, 2, 3, 4, 5, 6}};
  EXPECT_EQ(rgbaOf(picture), (Bytes{1, 2, 3, 255, 4, 5, 6, 255}));
}

}  // namespace
}  // namespace careen
