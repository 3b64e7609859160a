#include "image/light_average.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace careen {
namespace {

// IEC 61966-2-1.
double light(int code) {
  const double value = code / 255.0;
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}
double codeOf(double linear) {
  return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

Picture gray(std::vector<std::uint8_t> codes) {
  const auto width = static_cast<int>(codes.size() / 3);
  return {.width = width, .height = 1, .rgb = std::move(codes)};
}

std::vector<std::uint8_t> allCodes() {
  std::vector<std::uint8_t> codes;
  for (int code = 0; code < 256; ++code) {
    codes.insert(codes.end(), 3, static_cast<std::uint8_t>(code));
  }
  return codes;
}

TEST(LightAverage, ofEqualPicturesIsThatPicture) {
  for (const int count : {1, 2, 7, 8, 255, 256}) {
    LightAverage average;
    average.add(gray(allCodes()), count);
    EXPECT_EQ(average.average().rgb, allCodes()) << count;
    EXPECT_EQ(average.average().width, 256);
  }
}

// Half of the light of white is code 188, not 128.
TEST(LightAverage, isOfLightNotOfCodes) {
  LightAverage average;
  average.add(gray({0, 255, 0}));
  average.add(gray({255, 255, 0}));
  EXPECT_EQ(average.average().rgb, (std::vector<std::uint8_t>{188, 255, 0}));
}

TEST(LightAverage, isTheNearestCode) {
  std::mt19937 random(1);
  for (const int count : {2, 3, 8, 100, 256}) {
    constexpr std::size_t kBytes = 3000;
    LightAverage average;
    std::vector<double> sums(kBytes);
    for (int i = 0; i < count; ++i) {
      std::vector<std::uint8_t> codes(kBytes);
      for (std::size_t k = 0; k < kBytes; ++k) {
        codes[k] = static_cast<std::uint8_t>(random() % (k < kBytes / 2 ? 256 : 12));  // dark values, too
        sums[k] += light(codes[k]);
      }
      average.add(gray(codes));
    }
    const Picture picture = average.average();
    for (std::size_t k = 0; k < kBytes; ++k) {
      EXPECT_NEAR(picture.rgb[k], codeOf(sums[k] / count), 0.5 + 0.06) << count;  // 16 bits resolve less in
                                                                                  // the dark
    }
  }
}

TEST(LightAverage, weightIsHowOftenAPictureCounts) {
  LightAverage once;
  LightAverage thrice;
  for (int i = 0; i < 3; ++i) {
    once.add(gray({10, 200, 90}));
  }
  once.add(gray({250, 0, 91}));
  thrice.add(gray({10, 200, 90}), 3);
  thrice.add(gray({250, 0, 91}));
  EXPECT_EQ(once.average().rgb, thrice.average().rgb);
}

}  // namespace
}  // namespace careen
