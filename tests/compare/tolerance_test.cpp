#include "compare/tolerance.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "pictures_to_compare.h"

namespace careen {
namespace {

Verdict verdictOf(const DeepPicture& one, const DeepPicture& other, const char* name) {
  return judge(differenceOf(one, other), toleranceOf(name)).verdict;
}

DeepPicture withPixels(DeepPicture picture, int count, int change) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    std::uint8_t& red = picture.samples8[i * 97 * 3];
    red = static_cast<std::uint8_t>(red + change);
  }
  return picture;
}

const DeepPicture& box() {
  static const DeepPicture kBox = BoxPicture{}.draw();
  return kBox;
}

TEST(Tolerance, namesAreThoseThereAre) {
  for (const std::string_view name : kToleranceNames) {
    EXPECT_EQ(judge(differenceOf(box(), box()), toleranceOf(name)).verdict, Verdict::kSame);
  }
  try {
    toleranceOf("alike");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "found 'alike', expected one of: exact, same-machine, same-picture, other-renderer");
  }
}

// 320 x 180: 0.005 % are 2.9 pixels, 0.01 % are 5.8.
TEST(Tolerance, eachNameAllowsWhatItSays) {
  EXPECT_EQ(verdictOf(box(), withPixels(box(), 1, 1), "exact"), Verdict::kDifferent);
  EXPECT_NE(verdictOf(box(), withPixels(box(), 2, 1), "same-machine"), Verdict::kDifferent);
  EXPECT_EQ(verdictOf(box(), withPixels(box(), 3, 1), "same-machine"), Verdict::kDifferent);
  EXPECT_EQ(verdictOf(box(), withPixels(box(), 1, 2), "same-machine"), Verdict::kDifferent);
  EXPECT_EQ(verdictOf(box(), withPixels(box(), 280, 1), "same-picture"), Verdict::kSame);
  EXPECT_EQ(verdictOf(box(), withPixels(box(), 300, 1), "same-picture"), Verdict::kWarning);
  EXPECT_EQ(verdictOf(box(), withPixels(box(), 5, 3), "same-picture"), Verdict::kSame);
  EXPECT_EQ(verdictOf(box(), withPixels(box(), 6, 3), "same-picture"), Verdict::kDifferent);
}

TEST(Tolerance, aBoxAPixelOffIsNotTheSamePicture) {
  EXPECT_EQ(verdictOf(box(), BoxPicture{.left = 61.3}.draw(), "same-picture"), Verdict::kDifferent);
  EXPECT_EQ(verdictOf(box(), BoxPicture{.top = 39.6}.draw(), "same-picture"), Verdict::kDifferent);
  EXPECT_EQ(verdictOf(box(), BoxPicture{.red = 203}.draw(), "same-picture"), Verdict::kDifferent);
  EXPECT_EQ(verdictOf(BoxPicture{.size = 4}.draw(1280, 720),
                      BoxPicture{.left = 61.3, .size = 4}.draw(1280, 720), "same-picture"),
            Verdict::kDifferent);
}

TEST(Tolerance, anotherRendererMayBlendEdgesOtherwiseButNotMoveThem) {
  EXPECT_EQ(verdictOf(box(), BoxPicture{.left = 60.6, .top = 40.3}.draw(), "other-renderer"), Verdict::kSame);
  EXPECT_EQ(verdictOf(box(), BoxPicture{.left = 62.3}.draw(), "other-renderer"), Verdict::kDifferent);
  EXPECT_EQ(verdictOf(box(), BoxPicture{.red = 212}.draw(), "other-renderer"), Verdict::kDifferent);
}

// The options of idiff, and its way to count: above the threshold, above the percentage.
TEST(Tolerance, meansWhatIdiffMeans) {
  const DeepPicture black = flatPicture(10, 10, 0, 0, 0);
  DeepPicture other = black;
  other.samples8[0] = 10;
  other.samples8[3 * 50 + 1] = 20;
  other.samples8[3 * 99 + 2] = 30;
  const PictureDifference difference = differenceOf(black, other);
  const auto verdict = [&difference](Tolerance tolerance) { return judge(difference, tolerance).verdict; };
  EXPECT_EQ(verdict({}), Verdict::kDifferent);
  EXPECT_EQ(verdict({.failPercent = 2.9, .warnPercent = 100}), Verdict::kDifferent);
  EXPECT_EQ(verdict({.failPercent = 3, .warnPercent = 100}), Verdict::kSame);
  EXPECT_EQ(verdict({.failPercent = 3}), Verdict::kWarning);
  EXPECT_EQ(verdict({.fail = 20.0 / 255, .failPercent = 1, .warnPercent = 100}), Verdict::kSame);
  EXPECT_EQ(verdict({.fail = 19.9 / 255, .failPercent = 1, .warnPercent = 100}), Verdict::kDifferent);
  EXPECT_EQ(verdict({.fail = 1, .hardFail = 30.0 / 255, .warn = 1}), Verdict::kSame);
  EXPECT_EQ(verdict({.fail = 1, .hardFail = 29.0 / 255, .warn = 1}), Verdict::kDifferent);
  EXPECT_EQ(verdict({.fail = 1, .warn = 1, .hardWarn = 29.0 / 255}), Verdict::kWarning);
  EXPECT_EQ(judge(difference, {.fail = 1, .hardFail = 0.1}).reasons,
            (std::vector<std::string>{"blue differs by 0.1176 at (9, 9); at most 0.1 is allowed"}));
  EXPECT_EQ(judge(difference, {.failPercent = 0.5}).reasons,
            (std::vector<std::string>{"3 % of the pixels differ by more than 0; at most 0.5 % may"}));
}

TEST(SetLimit, setsTheNumberOfThatName) {
  Tolerance tolerance = toleranceOf("exact");
  EXPECT_EQ(setLimit(tolerance, "failpercent=5"), "failpercent=5");
  EXPECT_EQ(tolerance.failPercent, 5);
  EXPECT_EQ(setLimit(tolerance, "hardfail=2.5"), "hardfail=2.5");
  EXPECT_EQ(tolerance.hardFail, 2.5);
  EXPECT_EQ(setLimit(tolerance, "windowssim=0.3"), "windowssim=0.3");
  EXPECT_EQ(tolerance.leastWindowSsim, 0.3);
  for (const char* const text :
       {"fail", "fail=", "fail=-1", "fail=1.1", "fail=nan", "fail=x", "heat=1", ""}) {
    EXPECT_THROW(setLimit(tolerance, text), InputError) << text;
  }
}

}  // namespace
}  // namespace careen
