#include "compare/ignored_regions.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "image/png.h"
#include "support/input_error.h"
#include "support/png_by_hand.h"
#include "support/process.h"

namespace careen {
namespace {

using Bits = std::vector<bool>;

IgnoredRegions regionsOf(const std::vector<std::string>& texts) {
  IgnoredRegions regions;
  for (const std::string& text : texts) {
    regions.add(text);
  }
  return regions;
}

DeepPicture rowOf(int channels, const std::vector<std::uint8_t>& samples) {
  return {.width = static_cast<int>(samples.size()) / channels,
          .height = 1,
          .channels = channels,
          .samples8 = samples,
          .samples16 = {}};
}

TEST(IgnoredRegions, withoutAnyAllCount) {
  EXPECT_TRUE(IgnoredRegions().of(3, 2).empty());
  EXPECT_FALSE(IgnoredRegions().of(3, 2).at(1, 1));
}

TEST(IgnoredRegions, rectanglesAreThosePixelsAndNoOthers) {
  const IgnoredRegions regions = regionsOf({"1,0,2,1", "0,2,1,1"});
  EXPECT_EQ(regions.names(), (std::vector<std::string>{"1,0,2,1", "0,2,1,1"}));
  const PixelMask mask = regions.of(4, 3);
  EXPECT_EQ(mask.ignored, (Bits{false, true, true, false, false, false, false, false, true, false, false,  //
                                false}));
  EXPECT_EQ(mask.count, 3U);
  EXPECT_TRUE(mask.at(2, 0));
  EXPECT_FALSE(mask.at(2, 1));
  EXPECT_EQ(regionsOf({"0,0,2,2", "1,1,2,2"}).of(4, 4).count, 7U);  // one pixel is in both
}

TEST(IgnoredRegions, whiteOfAMaskIsIgnored) {
  const TemporaryFolder folder;
  const std::string path = folder / "mask.png";
  const Picture mask{.width = 4, .height = 1, .rgb = {255, 255, 255, 128, 128, 128, 127, 255, 255, 0, 0, 0}};
  writePng(path, mask);
  EXPECT_EQ(regionsOf({path}).of(4, 1).ignored, (Bits{true, true, false, false}));
  EXPECT_EQ(regionsOf({"3,0,1,1", path}).of(4, 1).ignored, (Bits{true, true, false, true}));
  // White that nobody sees, and 16 bits of grey.
  folder.write(
      "mask.png",
      PngByHand{
          .width = 2, .bits = 16, .color = 4, .rows = std::string("\0\xff\xff\x7f\xff\x80\x00\x80\x00", 9)}
          .bytes());
  EXPECT_EQ(regionsOf({path}).of(2, 1).ignored, (Bits{false, true}));
}

TEST(IgnoredRegions, otherTextsAreRefused) {
  const TemporaryFolder folder;
  writePng(folder / "black.png", {.width = 1, .height = 1, .rgb = {0, 0, 0}});
  folder.write("none.png", "no picture");
  for (const char* text : {"", "1,2,3", "1,2,3,4,5", "1,2,3,x", "1;2;3;4", "1, 2,3,4", "99999999999,0,1,1"}) {
    EXPECT_EQ(
        inputErrorOf([&] { regionsOf({text}); }),
        "--ignore: found '" + std::string(text) + "', expected x,y,width,height in pixels, or a PNG mask");
  }
  for (const char* text : {"-1,0,1,1", "0,-1,1,1", "0,0,0,1", "0,0,1,0"}) {
    EXPECT_EQ(
        inputErrorOf([&] { regionsOf({text}); }),
        "--ignore: found '" + std::string(text) + "', expected x and y from 0, width and height from 1");
  }
  EXPECT_NE(inputErrorOf([&] { regionsOf({folder / "black.png"}); }).find("found no white pixel in "),
            std::string::npos);
  EXPECT_NE(inputErrorOf([&] { regionsOf({folder / "none.png"}); }).find("is no PNG"), std::string::npos);
  EXPECT_NE(inputErrorOf([&] { regionsOf({folder / "nowhere.png"}); }), "");
}

TEST(IgnoredRegions, mustFitThePicture) {
  const TemporaryFolder folder;
  writePng(folder / "mask.png", {.width = 1, .height = 2, .rgb = {255, 255, 255, 0, 0, 0}});
  EXPECT_EQ(regionsOf({"1,0,3,2"}).of(4, 3).count, 6U);
  for (const char* text : {"2,0,3,2", "1,2,3,2", "4,0,1,1", "0,3,1,1", "2147483647,0,2147483647,1"}) {
    EXPECT_EQ(
        inputErrorOf([&] { regionsOf({text}).of(4, 3); }),
        "--ignore: found " + std::string(text) + ", expected a rectangle within the pictures' 4x3 pixels");
  }
  EXPECT_EQ(inputErrorOf([&] { regionsOf({folder / "mask.png"}).of(2, 1); }),
            "--ignore: found " + (folder / "mask.png").string() +
                " of 1x2 pixels, expected a mask of the pictures' 2x1 pixels");
  EXPECT_EQ(inputErrorOf([&] {
              regionsOf({"0,0,4,2", "0,2,4,1"}).of(4, 3);
            }),
            "--ignore: found all of the pictures' 4x3 pixels ignored, expected some that count");
}

TEST(IgnoredRegions, comparablePicturesHaveTheRicherFormat) {
  DeepPicture expected = rowOf(3, {1, 2, 3});
  DeepPicture actual{
      .width = 1, .height = 1, .channels = 4, .deep = true, .samples8 = {}, .samples16 = {1, 2, 3, 65534}};
  makeComparable(expected, actual, {});
  EXPECT_EQ(expected.samples16, (std::vector<std::uint16_t>{257, 514, 771, 65535}));
  EXPECT_EQ(actual.samples16, (std::vector<std::uint16_t>{1, 2, 3, 65534}));
  DeepPicture other = rowOf(3, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(inputErrorOf([&] { makeComparable(expected, other, {}); }),
            "found a picture of 2x1 pixels, expected one of 1x1");
}

TEST(IgnoredRegions, whatDoesNotCountIsMadeTheSame) {
  DeepPicture expected = rowOf(3, {1, 2, 3, 4, 5, 6});
  DeepPicture actual = rowOf(3, {9, 9, 9, 8, 8, 8});
  makeComparable(expected, actual, regionsOf({"1,0,1,1"}).of(2, 1));
  EXPECT_EQ(actual.samples8, (std::vector<std::uint8_t>{9, 9, 9, 4, 5, 6}));
  // Fully transparent in both, in one, in neither.
  expected = rowOf(4, {1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 4});
  actual = rowOf(4, {9, 9, 9, 0, 9, 9, 9, 1, 9, 9, 9, 4});
  makeComparable(expected, actual, {});
  EXPECT_EQ(actual.samples8, (std::vector<std::uint8_t>{1, 2, 3, 0, 9, 9, 9, 1, 9, 9, 9, 4}));
}

}  // namespace
}  // namespace careen
