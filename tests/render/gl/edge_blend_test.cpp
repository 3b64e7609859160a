#include "render/gl/edge_blend.h"

#include <gtest/gtest.h>

#include <vector>

#include "image/srgb.h"

namespace careen {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::uint8_t alphaOf(int direction, double at) {
  return static_cast<std::uint8_t>(1 + kEdgeSteps * direction + static_cast<int>(kEdgeSteps * at));
}

Bytes gray(std::initializer_list<std::pair<int, std::uint8_t>> pixels) {
  Bytes rgba;
  for (const auto& [value, alpha] : pixels) {
    rgba.insert(rgba.end(), 3, static_cast<std::uint8_t>(value));
    rgba.push_back(alpha);
  }
  return rgba;
}

Bytes blended(const Bytes& rgba, int width, int height) {
  Bytes result(rgba.size());
  blendEdges(rgba, width, height, {.left = 0, .bottom = 0, .right = width, .top = height}, result);
  return result;
}

double light(const Bytes& rgba, std::size_t pixel) {
  return SrgbTables::get().linear(rgba.at(4 * pixel)) / 65535.0;
}

TEST(EdgeBlend, givesAPixelItsShareOfTheColourBeyondTheEdge) {
  // White up to 0.3 of the way to the pixel on the right, black after: a fifth of the first is black.
  const Bytes near = blended(gray({{255, alphaOf(0, 0.3)}, {0, kNoEdge}}), 2, 1);
  EXPECT_NEAR(light(near, 0), 0.8, 0.01);
  EXPECT_EQ(near.at(4), 0);
  // Up to 0.8: three tenths of the second are white.
  const Bytes far = blended(gray({{255, alphaOf(0, 0.8)}, {0, kNoEdge}}), 2, 1);
  EXPECT_EQ(far.at(0), 255);
  EXPECT_NEAR(light(far, 1), 0.3, 0.01);
}

TEST(EdgeBlend, knowsAllFourDirections) {
  const auto middleOf = [](int direction) {
    std::initializer_list<std::pair<int, std::uint8_t>> none = {};
    Bytes rgba = gray(none);
    for (int k = 0; k < 9; ++k) {
      rgba.insert(rgba.end(), 3, static_cast<std::uint8_t>(k == 4 ? 255 : 0));
      rgba.push_back(k == 4 ? alphaOf(direction, 0.7) : kNoEdge);
    }
    const Bytes result = blended(rgba, 3, 3);
    std::vector<std::size_t> lit;
    for (std::size_t k = 0; k < 9; ++k) {
      if (k != 4 && result.at(4 * k) > 0) {
        lit.push_back(k);
      }
    }
    return lit;
  };
  EXPECT_EQ(middleOf(0), std::vector<std::size_t>{5});
  EXPECT_EQ(middleOf(1), std::vector<std::size_t>{3});
  EXPECT_EQ(middleOf(2), std::vector<std::size_t>{7});  // rows from the bottom
  EXPECT_EQ(middleOf(3), std::vector<std::size_t>{1});
}

TEST(EdgeBlend, takesAnEdgeThatBothSidesKnowOnce) {
  const Bytes once = blended(gray({{255, alphaOf(0, 0.3)}, {0, kNoEdge}}), 2, 1);
  const Bytes both = blended(gray({{255, alphaOf(0, 0.3)}, {0, alphaOf(1, 0.7)}}), 2, 1);
  EXPECT_NEAR(light(both, 0), light(once, 0), 0.01);
  EXPECT_EQ(both.at(4), 0);
}

// Where the edge passes from one column to the next both may know it, the first as beyond its neighbour.
TEST(EdgeBlend, leavesAnEdgeBeyondTheNextPixelToThatOne) {
  const Bytes alone = blended(gray({{80, kNoEdge}, {255, alphaOf(0, 0.01)}, {0, kNoEdge}}), 3, 1);
  const Bytes both = blended(gray({{80, alphaOf(0, 0.999)}, {255, alphaOf(0, 0.01)}, {0, kNoEdge}}), 3, 1);
  for (std::size_t pixel = 0; pixel < 3; ++pixel) {
    EXPECT_EQ(both.at(4 * pixel), alone.at(4 * pixel)) << pixel;
  }
  // Another edge, with some of the second pixel before it.
  const Bytes thin = blended(gray({{80, alphaOf(0, 0.999)}, {255, alphaOf(0, 0.3)}, {0, kNoEdge}}), 3, 1);
  EXPECT_LT(light(thin, 1), light(alone, 1));
}

TEST(EdgeBlend, leavesPixelsWithoutEdgesAndThoseAtTheBorderAlone) {
  const Bytes plain = gray({{255, kNoEdge}, {0, kNoEdge}, {9, kNoEdge}});
  EXPECT_EQ(blended(plain, 3, 1), plain);
  const Bytes border = gray({{255, alphaOf(1, 0.2)}, {0, alphaOf(2, 0.2)}, {9, alphaOf(0, 0.9)}});
  EXPECT_EQ(blended(border, 3, 1), border);
}

}  // namespace
}  // namespace careen
