#include "render/gl/canvas.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.h"
#include "core/system/release.h"

namespace careen {
namespace {

std::string errorOf(const std::vector<std::uint8_t>& rgba) {
  try {
    refuseBlack(pictureFromDrawing(rgba, 2, 2, 1, "a renderer, version 1"), "a renderer, version 1");
  } catch (const MachineError& error) {
    return error.what();
  }
  return {};
}

TEST(Canvas, turnsRowsFromTheBottomIntoRowsFromTheTop) {
  const std::vector<std::uint8_t> rgba = {1, 2, 3, 255, 4, 5, 6, 255, 7, 8, 9, 255, 10, 11, 12, 255};
  const Picture picture = pictureFromDrawing(rgba, 2, 2, 1, "");
  EXPECT_EQ(picture.rgb, (std::vector<std::uint8_t>{7, 8, 9, 10, 11, 12, 1, 2, 3, 4, 5, 6}));
}

// Two black pixels and two white ones are half the light, which is not half the code.
TEST(Canvas, averagesLightWhereItDrewFinerThanThePicture) {
  const std::vector<std::uint8_t> rgba = {0, 0, 0, 255, 255, 255, 255, 255, 255, 255, 255, 255, 0, 0, 0, 9};
  const Picture picture = pictureFromDrawing(rgba, 1, 1, 2, "");
  EXPECT_EQ(picture.rgb, (std::vector<std::uint8_t>{188, 188, 188}));
}

TEST(Canvas, oneBlankPixelIsAnError) {
  std::vector<std::uint8_t> rgba(16, 255);
  EXPECT_EQ(errorOf(rgba), "");
  rgba[7] = 0;
  const std::string said = errorOf(rgba);
  EXPECT_NE(said.find("blank"), std::string::npos) << said;
  EXPECT_NE(said.find("a renderer, version 1"), std::string::npos) << said;
  EXPECT_NE(said.find("apt install " + std::string(drawingPackages())), std::string::npos) << said;
}

TEST(Canvas, allBlackIsAnErrorAndOneDarkPixelIsNot) {
  std::vector<std::uint8_t> rgba = {0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255};
  EXPECT_NE(errorOf(rgba).find("black"), std::string::npos) << errorOf(rgba);
  rgba[5] = 1;
  EXPECT_EQ(errorOf(rgba), "");
}

}  // namespace
}  // namespace careen
