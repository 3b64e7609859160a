#include "image/matte.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace careen {
namespace {

using Bytes = std::vector<std::uint8_t>;

Picture row(Bytes rgb) {
  const auto width = static_cast<int>(rgb.size() / 3);
  return {.width = width, .height = 1, .rgb = std::move(rgb)};
}

Picture onePixel(const Bytes& boxes, std::uint8_t covered, const Bytes& stage, const Bytes& emptyStage) {
  return onNothing({.boxes = row(boxes),
                    .coverage = row(Bytes(3, covered)),
                    .stage = row(stage),
                    .emptyStage = row(emptyStage)});
}

// As image programs lay a picture over an opaque one.
double over(const Picture& picture, std::size_t sample, double below) {
  const double alpha = picture.alpha[sample / 3] / 255.0;
  return alpha * picture.rgb[sample] + (1 - alpha) * below;
}

TEST(Matte, aPixelThatABoxFillsHasItsColour) {
  const Picture picture = onePixel({200, 90, 7}, 255, {1, 2, 3}, {250, 250, 250});
  EXPECT_EQ(picture.rgb, (Bytes{200, 90, 7}));
  EXPECT_EQ(picture.alpha, (Bytes{255}));
}

TEST(Matte, whatNothingChangedIsNotThere) {
  const Picture picture = onePixel({0, 0, 0}, 0, {30, 200, 255}, {31, 199, 255});
  EXPECT_EQ(picture.alpha, (Bytes{0}));
  EXPECT_EQ(picture.rgb, (Bytes{0, 0, 0}));
}

// Half the light of a white box on black is 188 of 255, and so is white over half the pixel.
TEST(Matte, anEdgeHasTheBoxesOwnColourAndItsPartAsAlpha) {
  const Picture picture = onePixel({188, 188, 0}, 188, {50, 50, 50}, {50, 50, 50});
  EXPECT_NEAR(picture.alpha[0], 127.5, 1.5);
  EXPECT_GE(picture.rgb[0], 254);
  EXPECT_EQ(picture.rgb[2], 0);
}

TEST(Matte, aGreyShadowIsBlackByThePartThatItTakes) {
  const Picture picture = onePixel({0, 0, 0}, 0, {100, 50, 20}, {200, 100, 40});
  EXPECT_EQ(picture.alpha, (Bytes{128}));
  EXPECT_LE(picture.rgb[0], 1);
  EXPECT_LE(picture.rgb[1], 1);
}

// In front of a shadow: over black nothing but the box is left, over white the shadow's part is missing.
TEST(Matte, anEdgeBeforeAShadowHasBoth) {
  const Picture picture = onePixel({0, 0, 0}, 188, {100, 100, 100}, {200, 200, 200});
  EXPECT_NEAR(picture.alpha[0], 255 * (0.5 + 0.5 * 0.5), 2);
  EXPECT_LE(picture.rgb[0], 1);
}

TEST(Matte, laidOverTheEmptyStageItIsTheStageWithShadows) {
  std::mt19937 random(3);
  Bytes stage(30000);
  Bytes emptyStage(stage.size());
  for (std::size_t i = 0; i < stage.size(); ++i) {
    stage[i] = static_cast<std::uint8_t>(random());
    emptyStage[i] = static_cast<std::uint8_t>(random());
  }
  const Bytes nothing(stage.size());
  const Picture picture = onNothing(
      {.boxes = row(nothing), .coverage = row(nothing), .stage = row(stage), .emptyStage = row(emptyStage)});
  double worst = 0;
  for (std::size_t i = 0; i < stage.size(); ++i) {
    worst = std::max(worst, std::abs(over(picture, i, emptyStage[i]) - stage[i]));
  }
  EXPECT_LE(worst, 1);  // 0.5, and 1 where no alpha is spent on a single step
}

}  // namespace
}  // namespace careen
