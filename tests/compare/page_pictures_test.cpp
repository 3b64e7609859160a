#include "compare/page_pictures.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "compare/difference_image.h"
#include "comparisons.h"
#include "core/base64.h"
#include "core/system/file.h"
#include "support/process.h"

namespace careen {
namespace {

using Json = nlohmann::json;
using Places = std::vector<std::size_t>;

Comparison manyFrames(int frames, int firstOther, int worst) {
  Comparison comparison;
  for (int k = 0; k < frames; ++k) {
    comparison.frames.push_back(k < firstOther ? sameFrame(frameName(k))
                                               : otherFrame(frameName(k), k == worst ? 0.5 : 0.1));
  }
  return comparison;
}

// RFC 4648, 10.
TEST(PagePictures, firstAndWorstComeFirstAndOthersAreSpread) {
  const Comparison comparison = manyFrames(10'000, 1000, 7777);
  const Places places = framesToShow(comparison);
  ASSERT_EQ(places.size(), kPageFrames);
  EXPECT_EQ(places[0], 1000U);
  EXPECT_EQ(places[1], 7777U);
  EXPECT_EQ(places.back(), 9180U);  // 1000 + 10·8999/11; the last ones make room for the worst
  EXPECT_EQ(framesToShow(comparison, 1), Places{1000});
  EXPECT_EQ(framesToShow(manyFrames(5, 2, 3)), (Places{2, 3, 4}));
}

TEST(PagePictures, withoutDifferencesThereIsNothingToShow) {
  Comparison comparison = manyFrames(5, 5, 5);
  EXPECT_TRUE(framesToShow(comparison).empty());
  comparison.frames[3].identical = false;  // within the tolerance
  comparison.frames[3].largest = 0.001;
  EXPECT_EQ(framesToShow(comparison), Places{3});
}

TEST(PagePictures, areTheFilesTheDifferenceAndTheWorstPixel) {
  const TemporaryFolder folder;
  const Comparison comparison = filmComparison(folder.path(), 4, 2, 3);
  const Json pictures = Json::parse(picturesJson(comparison));
  EXPECT_EQ(pictures.size(), 2U);
  const Json& worst = pictures.at("000003.png");
  const std::string head = "data:image/png;base64,";
  EXPECT_EQ(worst.at("expected"), head + base64(readFile(folder / "expected/000003.png")));
  EXPECT_EQ(worst.at("actual"), head + base64(readFile(folder / "actual/000003.png")));
  EXPECT_TRUE(worst.at("difference").get<std::string>().starts_with(head));
  EXPECT_EQ(worst.at("factor"), 2);  // 120 of 255
  EXPECT_EQ(worst.at("width"), 96);
  EXPECT_EQ(worst.at("pixel"), Json::parse(R"({"x": 3, "y": 18, "full": 255, "expected": [100, 100, 100],
                                              "actual": [220, 220, 220]})"));
}

TEST(PagePictures, ofMissingAndBrokenFramesThereIsWhatThereIs) {
  const TemporaryFolder folder;
  Comparison comparison = filmComparison(folder.path(), 3, 1, 1);
  std::filesystem::remove(folder / "actual/000001.png");
  folder.write("actual/000002.png", "no picture");
  comparison.frames[1].measured = comparison.frames[2].measured = false;
  const Json pictures = Json::parse(picturesJson(comparison));
  for (const char* name : {"000001.png", "000002.png"}) {
    EXPECT_TRUE(pictures.at(name).at("expected").is_string());
    EXPECT_EQ(pictures.at(name).at("height"), 54);
    for (const char* key : {"actual", "difference", "factor", "pixel"}) {
      EXPECT_TRUE(pictures.at(name).at(key).is_null()) << name << " " << key;
    }
  }
}

TEST(PagePictures, areOfABoundedSizeButForTheFirst) {
  const TemporaryFolder folder;
  const Comparison comparison = filmComparison(folder.path(), 30, 5, 20);
  EXPECT_EQ(Json::parse(picturesJson(comparison)).size(), kPageFrames);
  const std::size_t one = Json::parse(picturesJson(comparison, 0)).dump().size();
  const Json few = Json::parse(picturesJson(comparison, 3 * one));
  EXPECT_GE(few.size(), 2U);
  EXPECT_LE(few.size(), 4U);
  EXPECT_TRUE(few.contains("000005.png"));
  EXPECT_EQ(Json::parse(picturesJson(comparison, 0)).size(), 1U);
}

TEST(PagePictures, ignoredRegionsAreMarkedAndBlackInTheDifference) {
  const TemporaryFolder folder;
  Comparison comparison = filmComparison(folder.path(), 4, 2, 3);
  EXPECT_TRUE(Json::parse(picturesJson(comparison)).at("000003.png").at("ignored").is_null());
  comparison.ignored.add("0,0,96,30");
  const Json worst = Json::parse(picturesJson(comparison)).at("000003.png");
  const std::string head = "data:image/png;base64,";
  const PixelMask mask = comparison.ignored.of(96, 54);
  EXPECT_EQ(worst.at("ignored"), head + base64(encodePng(ignoredImage(mask), PngColor{0, 0, 0})));
  DeepPicture expected = readDeepPng(folder / "expected/000003.png");
  DeepPicture actual = readDeepPng(folder / "actual/000003.png");
  makeComparable(expected, actual, mask);
  EXPECT_EQ(worst.at("difference"), head + base64(encodePng(differenceImage(expected, actual, 2))));
}

TEST(PagePictures, ofTwoSizesBothAreShown) {
  const TemporaryFolder folder;
  Comparison comparison = filmComparison(folder.path(), 2, 1, 1);
  writePng(folder / "actual/000001.png", squareOn(90, 60, 5, 200));
  comparison.frames[1].measured = false;
  const Json picture = Json::parse(picturesJson(comparison)).at("000001.png");
  EXPECT_TRUE(picture.at("expected").is_string() && picture.at("actual").is_string());
  EXPECT_EQ(picture.at("width"), 96);
  EXPECT_EQ(picture.at("height"), 60);
  EXPECT_TRUE(picture.at("difference").is_null());
}

}  // namespace
}  // namespace careen
