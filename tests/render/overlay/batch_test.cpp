#include "render/overlay/batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "render/draw/renderer.h"
#include "render/stage.h"

namespace careen {
namespace {

constexpr int kWidthOfBatch = 160;
constexpr int kHeightOfBatch = 90;

class OverlayBatchTest : public testing::Test {
 protected:
  Picture over(const OverlayShapes& shapes) { return over(renderer_, shapes); }
  Picture over(Renderer& renderer, const OverlayShapes& shapes) {
    Picture picture = renderer.draw(posesOf(scene_));
    renderer.drawOver(picture, shapes);
    return picture;
  }
  Picture bare() { return renderer_.draw(posesOf(scene_)); }
  static std::size_t differences(const Picture& a, const Picture& b) {
    std::size_t found = 0;
    for (int y = 0; y < kHeightOfBatch; ++y) {
      for (int x = 0; x < kWidthOfBatch; ++x) {
        found += pixelAt(a, x, y) == pixelAt(b, x, y) ? 0U : 1U;
      }
    }
    return found;
  }

  Scene scene_ = crateInRoom();
  Renderer renderer_{setupOf(scene_, kWidthOfBatch, kHeightOfBatch)};
};

const Color kRed{200, 40, 10};
const std::array<int, 3> kRedPixel = {200, 40, 10};

TEST_F(OverlayBatchTest, plateCoversItsPixelsAndNoOthers) {
  const Picture without = bare();
  const Picture with = over({Plate{.min = Vec2(20, 30), .max = Vec2(50, 40), .ink = {kRed, 1}}});
  for (int y = 0; y < kHeightOfBatch; ++y) {
    for (int x = 0; x < kWidthOfBatch; ++x) {
      const bool inside = x >= 20 && x < 50 && y >= 30 && y < 40;
      ASSERT_EQ(pixelAt(with, x, y), inside ? kRedPixel : pixelAt(without, x, y)) << x << ' ' << y;
    }
  }
}

TEST_F(OverlayBatchTest, inkMixesWithWhatIsBelow) {
  const Picture without = bare();
  const Picture with = over({Plate{.min = Vec2(20, 30), .max = Vec2(50.25, 40), .ink = {kRed, 0.5}}});
  for (int channel = 0; channel < 3; ++channel) {
    const auto at = static_cast<std::size_t>(channel);
    EXPECT_NEAR(pixelAt(with, 30, 35)[at], 0.5 * (kRedPixel[at] + pixelAt(without, 30, 35)[at]), 2);
    // A quarter of this pixel's breadth is covered.
    EXPECT_NEAR(pixelAt(with, 50, 35)[at], 0.125 * kRedPixel[at] + 0.875 * pixelAt(without, 50, 35)[at], 2);
  }
}

// Over nothing there is the ink alone, over half a red both: by the rule for colours with alpha.
TEST_F(OverlayBatchTest, inkOverNothingKeepsItsColourAndHasAlpha) {
  const std::size_t pixels = std::size_t{kWidthOfBatch} * kHeightOfBatch;
  Picture picture{.width = kWidthOfBatch, .height = kHeightOfBatch, .rgb = {}};
  picture.rgb.assign(3 * pixels, 100);
  picture.alpha.assign(pixels, 0);
  const auto place = [](int x, int y) { return static_cast<std::size_t>(y * kWidthOfBatch + x); };
  picture.alpha[place(40, 35)] = 128;
  renderer_.drawOver(picture, {Plate{.min = Vec2(20, 30), .max = Vec2(50, 40), .ink = {kRed, 0.5}}});
  EXPECT_NEAR(picture.alpha[place(30, 35)], 127.5, 1);
  EXPECT_EQ(picture.alpha[place(10, 35)], 0);
  EXPECT_NEAR(picture.alpha[place(40, 35)], 255 * 0.75, 1.5);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(pixelAt(picture, 30, 35)[channel], kRedPixel[channel], 2);
    EXPECT_NEAR(pixelAt(picture, 40, 35)[channel], (0.5 * kRedPixel[channel] + 0.25 * 100) / 0.75, 2);
  }
}

TEST_F(OverlayBatchTest, arrowReachesFromEndToEnd) {
  const Picture without = bare();
  const Picture with = over(
      {Stroke{.from = Vec2(20.5, 30.5), .to = Vec2(80.5, 30.5), .width = 3, .head = 12, .ink = {kRed, 1}}});
  for (const int x : {20, 40, 66, 75, 78}) {
    EXPECT_EQ(pixelAt(with, x, 30), kRedPixel) << x;
  }
  EXPECT_EQ(pixelAt(with, 82, 30), pixelAt(without, 82, 30));
  EXPECT_EQ(pixelAt(with, 17, 30), pixelAt(without, 17, 30));
  EXPECT_EQ(pixelAt(with, 40, 33), pixelAt(without, 40, 33));  // beside the shaft
  EXPECT_EQ(pixelAt(with, 70, 33), kRedPixel);                 // the head is broader
}

TEST_F(OverlayBatchTest, discIsRoundAndItsRimDark) {
  const Picture with = over(
      {Stroke{.from = Vec2(60.5, 40.5), .to = Vec2(60.5, 40.5), .width = 11, .halo = 3, .ink = {kRed, 1}}});
  EXPECT_EQ(pixelAt(with, 60, 36), kRedPixel);
  EXPECT_EQ(pixelAt(with, 56, 40), kRedPixel);
  EXPECT_NE(pixelAt(with, 56, 36), kRedPixel);  // 5.7 px away from the middle
  const std::array<int, 3> rim = pixelAt(with, 60, 33);
  EXPECT_LT(rim[0] + rim[1] + rim[2], 250);
}

// Translucent, bent, in many pieces: were a pixel covered by two, it would be darker than the rest.
TEST_F(OverlayBatchTest, ribbonHasNoSeams) {
  scene_.room.reset();
  RenderOptions options;
  options.lighting = evenLighting(Vec3::Ones());
  scene_.boxes[0].pose.position = Vec3(100, 0, 0);
  Renderer renderer(setupOf(scene_, kWidthOfBatch, kHeightOfBatch), options);
  Ribbon ribbon{.points = {}, .width = 8, .ink = {kRed, 0.5}};
  for (int i = 0; i <= 60; ++i) {
    const double turn = 0.04 * i;
    ribbon.points.push_back({.at = Vec2(80 + 35 * std::cos(turn), 20 + 35 * std::sin(turn))});
  }
  const Picture below = renderer.draw(posesOf(scene_));
  Picture picture = below;
  renderer.drawOver(picture, {ribbon});
  int covered = 0;
  for (int y = 0; y < kHeightOfBatch; ++y) {
    for (int x = 0; x < kWidthOfBatch; ++x) {
      const double once = 0.5 * (pixelAt(below, x, y)[1] + kRedPixel[1]);
      EXPECT_GE(pixelAt(picture, x, y)[1], once - 2) << x << ' ' << y;
      covered += pixelAt(picture, x, y)[1] <= once + 2 ? 1 : 0;
    }
  }
  EXPECT_NEAR(covered, 8 * 35 * 2.4, 100);
}

TEST_F(OverlayBatchTest, textIsWrittenWhereItBelongs) {
  const Picture without = bare();
  const Label label{.text = "Hé", .at = Vec2(30, 50), .size = 20, .ink = {kRed, 1}};
  const Picture with = over({label});
  const double width = findFont(kPlainFont).width(label.text, label.size);
  EXPECT_GT(differences(with, without), 60U);
  std::size_t full = 0;
  for (int y = 0; y < kHeightOfBatch; ++y) {
    for (int x = 0; x < kWidthOfBatch; ++x) {
      const bool inside = x >= 30 && x < 30 + width + 1 && y >= 30 && y < 51;
      ASSERT_TRUE(inside || pixelAt(with, x, y) == pixelAt(without, x, y)) << x << ' ' << y;
      full += pixelAt(with, x, y) == kRedPixel ? 1U : 0U;
    }
  }
  EXPECT_GT(full, 20U);
}

TEST_F(OverlayBatchTest, sameShapesGiveTheSameBytes) {
  const OverlayShapes shapes = {
      Plate{.min = Vec2(3.3, 5.1), .max = Vec2(70, 31), .rounding = 6, .ink = {kRed, 0.6}},
      Label{.text = "00:00:01.234", .at = Vec2(8, 22), .size = 12, .typeface = Typeface::kMonospaced},
      Stroke{.from = Vec2(10, 60), .to = Vec2(90, 77), .width = 2, .head = 9, .halo = 1, .ink = {kRed, 0.7}}};
  const Picture first = over(shapes);
  over({Label{.text = "something else first", .at = Vec2(1, 60), .size = 13}});
  EXPECT_EQ(over(shapes).rgb, first.rgb);
  Renderer another(setupOf(scene_, kWidthOfBatch, kHeightOfBatch));
  EXPECT_EQ(over(another, shapes).rgb, first.rgb);
}

TEST_F(OverlayBatchTest, nextPictureWithoutOverlaysIsAsBefore) {
  const Picture before = bare();
  EXPECT_GT(differences(over({Plate{.min = Vec2(0, 0), .max = Vec2(90, 90), .ink = {kRed, 0.9}}}), before),
            5000U);
  EXPECT_EQ(bare().rgb, before.rgb);
}

TEST_F(OverlayBatchTest, withoutOverlaysThereIsNoPass) {
  bare();
  bare();
  EXPECT_EQ(renderer_.figures().overlayPasses, 0);
  over({});
  EXPECT_EQ(renderer_.figures().overlayPasses, 1);
}

}  // namespace
}  // namespace careen
