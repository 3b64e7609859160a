#include "compare/picture_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "compare/perceptual_color.h"
#include "core/error.h"
#include "pictures_to_compare.h"

namespace careen {
namespace {

TEST(PictureDifference, equalPicturesDifferInNothing) {
  const DeepPicture picture = deepPicture(noise(50, 40, 1));
  const PictureDifference difference = differenceOf(picture, picture);
  EXPECT_EQ(difference.pixels, 2000U);
  EXPECT_EQ(difference.differing, 0U);
  EXPECT_EQ(difference.largest, 0);
  EXPECT_EQ(difference.mean, 0);
  EXPECT_TRUE(std::isinf(difference.psnr()));
  EXPECT_EQ(difference.ssim, 1);
  EXPECT_EQ(difference.changed, 0U);
  EXPECT_EQ(difference.byStep[0], 2000U);
}

// Each figure by its definition, in doubles, for two pictures of noise.
TEST(PictureDifference, figuresAreThoseOfTheirDefinitions) {
  const Picture a = noise(61, 47, 1);
  const Picture b = noise(61, 47, 2);
  const PictureDifference difference = differenceOf(deepPicture(a), deepPicture(b));
  double sum = 0;
  double squares = 0;
  int largest = 0;
  std::size_t over40 = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
    int most = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const int step = b.rgb[i + k] - a.rgb[i + k];
      sum += std::abs(step);
      squares += step * step;
      most = std::max(most, std::abs(step));
    }
    largest = std::max(largest, most);
    over40 += most > 40 ? 1 : 0;
  }
  const auto samples = static_cast<double>(a.rgb.size());
  EXPECT_NEAR(difference.mean, sum / samples / 255, 1e-14);
  EXPECT_NEAR(difference.meanSquare, squares / samples / 255 / 255, 1e-14);
  EXPECT_NEAR(difference.psnr(), 10 * std::log10(255.0 * 255 * samples / squares), 1e-10);
  EXPECT_EQ(difference.largest, largest / 255.0);
  EXPECT_EQ(difference.pixelsOver(40.5 / 255), over40);
}

TEST(PictureDifference, theLargestDifferenceIsToldWithItsPlaceAndChannel) {
  const DeepPicture picture = deepPicture(flat(20, 10, 100));
  DeepPicture other = picture;
  other.samples8[461] = 40;  // blue of (13, 7); the next is red of (3, 2)
  other.samples8[129] = 130;
  const PictureDifference difference = differenceOf(picture, other);
  EXPECT_EQ(difference.differing, 2U);
  EXPECT_EQ(difference.largest, 60.0 / 255);
  EXPECT_EQ(difference.largestX, 13);
  EXPECT_EQ(difference.largestY, 7);
  EXPECT_EQ(difference.largestChannel, 2);
}

TEST(PictureDifference, seesTheLowByteOfSixteenBitsAndAlphaAlone) {
  DeepPicture deep = deepened(deepPicture(noise(8, 8, 1)));
  const DeepPicture before = deep;
  deep.samples16[40] ^= 1U;
  const PictureDifference low = differenceOf(before, deep);
  EXPECT_EQ(low.differing, 1U);
  EXPECT_EQ(low.largest, 1.0 / 65535);
  DeepPicture clear = withAlpha(deepPicture(noise(8, 8, 1)));
  clear.samples8[4 * 9 + 3] = 254;
  const PictureDifference alpha = differenceOf(deepPicture(noise(8, 8, 1)), clear);
  EXPECT_EQ(alpha.differing, 1U);
  EXPECT_EQ(alpha.largestChannel, 3);
  EXPECT_EQ(alpha.largest, 1.0 / 255);
}

TEST(PictureDifference, depthsAndAlphaThatSayTheSameAreTheSame) {
  const DeepPicture picture = deepPicture(noise(8, 8, 1));
  EXPECT_EQ(differenceOf(picture, deepened(picture)).differing, 0U);
  EXPECT_EQ(differenceOf(withAlpha(picture), picture).differing, 0U);
  EXPECT_EQ(differenceOf(withAlpha(deepened(picture)), picture).differing, 0U);
}

// White that becomes transparent is seen, and so is black.
TEST(PictureDifference, transparencyIsVisibleOverEveryColour) {
  for (const int level : {0, 255}) {
    const DeepPicture opaque = withAlpha(flatPicture(16, 16, level, level, level));
    DeepPicture clear = opaque;
    for (std::size_t i = 3; i < clear.samples8.size(); i += 4) {
      clear.samples8[i] = 0;
    }
    const PictureDifference difference = differenceOf(opaque, clear);
    EXPECT_EQ(difference.changed, 256U);
    EXPECT_LT(difference.ssim, 0.9);
  }
}

TEST(PictureDifference, otherSizesAreAnErrorThatNamesBoth) {
  try {
    differenceOf(deepPicture(flat(8, 4, 1)), deepPicture(flat(4, 8, 1)));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "found a picture of 4x8 pixels, expected one of 8x4");
  }
}

TEST(PictureDifference, visibleColoursAreCountedByTheirDistance) {
  const DeepPicture picture = flatPicture(12, 12, 200, 85, 61);
  const auto lab = [](int red) {
    return labOfLight(
        {lightOfSrgb(static_cast<float>(red) / 255), lightOfSrgb(85.0F / 255), lightOfSrgb(61.0F / 255)});
  };
  std::size_t visible = 0;
  for (int red = 202; red < 240; ++red) {
    const bool isVisible = static_cast<double>(ciede2000(lab(200), lab(red))) > kVisible;
    const PictureDifference difference = differenceOf(picture, flatPicture(12, 12, red, 85, 61));
    EXPECT_EQ(difference.changed, isVisible ? 144U : 0U) << red;
    EXPECT_EQ(difference.changedByEdges, 0U) << red;
    visible += isVisible ? 1 : 0;
  }
  EXPECT_GT(visible, 20U);
  EXPECT_LT(visible, 38U);
}

TEST(PictureDifference, edgesExplainAThirdOfAPixel) {
  const DeepPicture box = BoxPicture{}.draw();
  for (const double shift : {-0.33, -0.25, 0.1, 0.25, 0.33}) {
    const PictureDifference difference = differenceOf(box, BoxPicture{.left = 60.3 + shift}.draw());
    EXPECT_GT(difference.changed, 40U) << shift;
    EXPECT_EQ(difference.changedByEdges, difference.changed) << shift;
    EXPECT_EQ(difference.pixelsOver(1.0 / 255, false), 0U) << shift;
  }
}

// In each row of the box at least one pixel at either end.
TEST(PictureDifference, edgesDoNotExplainAWholePixelNorALineThatIsGone) {
  const DeepPicture box = BoxPicture{}.draw();
  for (const double left : {59.3, 61.3, 62.3}) {
    const PictureDifference difference = differenceOf(box, BoxPicture{.left = left}.draw());
    EXPECT_GE(difference.changed - difference.changedByEdges, 100U) << left;
  }
  DeepPicture line = box;
  for (std::size_t x = 0; x < 320; ++x) {
    for (std::size_t k = 0; k < 3; ++k) {
      line.samples8[19200 + 3 * x + k] = 20;
    }
  }
  for (const bool came : {false, true}) {
    const PictureDifference difference = came ? differenceOf(box, line) : differenceOf(line, box);
    EXPECT_EQ(difference.changed, 320U);
    EXPECT_EQ(difference.changedByEdges, 0U);
  }
}

// 10 x 10, of which 20 pixels are ignored, and one of the other 80 differs by 51.
TEST(PictureDifference, ignoredPixelsCountInNothing) {
  const DeepPicture expected = flatPicture(10, 10, 100, 100, 100);
  DeepPicture actual = expected;
  actual.samples8[3 * 55] = 151;
  IgnoredRegions regions;
  regions.add("0,0,10,2");
  const PixelMask ignored = regions.of(10, 10);
  for (std::size_t i = 0; i < 20; ++i) {
    actual.samples8[3 * i + 1] = 255;
  }
  const PictureDifference difference = differenceOf(expected, actual, ignored);
  EXPECT_EQ(difference.pixels, 80U);
  EXPECT_EQ(difference.differing, 1U);
  EXPECT_EQ(difference.byStep[0], 79U);
  EXPECT_EQ(difference.largest, 0.2);
  EXPECT_EQ(difference.largestX, 5);
  EXPECT_EQ(difference.largestY, 5);
  EXPECT_NEAR(difference.mean, 0.2 / 240, 1e-15);
  EXPECT_NEAR(difference.meanSquare, 0.04 / 240, 1e-15);
  EXPECT_EQ(difference.changed, 1U);
  actual.samples8[3 * 55] = 100;
  EXPECT_EQ(differenceOf(expected, actual, ignored).differing, 0U);
  EXPECT_EQ(differenceOf(expected, actual, ignored).ssim, 1);
}

TEST(PictureDifference, coloursOfFullyTransparentPixelsAreTheSame) {
  DeepPicture expected = withAlpha(flatPicture(4, 4, 1, 2, 3));
  DeepPicture actual = withAlpha(flatPicture(4, 4, 255, 0, 9));
  for (DeepPicture* const each : {&expected, &actual}) {
    for (std::size_t i = 0; i < 16; ++i) {
      each->samples8[4 * i + 3] = 0;
    }
  }
  EXPECT_EQ(differenceOf(expected, actual).differing, 0U);
  actual.samples8[3] = 1;  // no longer fully
  const PictureDifference difference = differenceOf(expected, actual);
  EXPECT_EQ(difference.differing, 1U);
  EXPECT_NEAR(difference.largest, 254.0 / 255, 1e-15);
}

}  // namespace
}  // namespace careen
