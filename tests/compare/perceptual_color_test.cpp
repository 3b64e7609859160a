#include "compare/perceptual_color.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/picture_difference.h"

namespace careen {
namespace {

// Table 1 of Sharma, Wu and Dalal, all 34 pairs: L, a, b; L, a, b; difference to four digits.
constexpr std::array<std::array<float, 7>, 34> kPublished{{
    {50.0F, 2.6772F, -79.7751F, 50.0F, 0.0F, -82.7485F, 2.0425F},
    {50.0F, 3.1571F, -77.2803F, 50.0F, 0.0F, -82.7485F, 2.8615F},
    {50.0F, 2.8361F, -74.0200F, 50.0F, 0.0F, -82.7485F, 3.4412F},
    {50.0F, -1.3802F, -84.2814F, 50.0F, 0.0F, -82.7485F, 1.0F},
    {50.0F, -1.1848F, -84.8006F, 50.0F, 0.0F, -82.7485F, 1.0F},
    {50.0F, -0.9009F, -85.5211F, 50.0F, 0.0F, -82.7485F, 1.0F},
    {50.0F, 0.0F, 0.0F, 50.0F, -1.0F, 2.0F, 2.3669F},
    {50.0F, -1.0F, 2.0F, 50.0F, 0.0F, 0.0F, 2.3669F},
    {50.0F, 2.49F, -0.001F, 50.0F, -2.49F, 0.0009F, 7.1792F},
    {50.0F, 2.49F, -0.001F, 50.0F, -2.49F, 0.0010F, 7.1792F},
    {50.0F, 2.49F, -0.001F, 50.0F, -2.49F, 0.0011F, 7.2195F},
    {50.0F, 2.49F, -0.001F, 50.0F, -2.49F, 0.0012F, 7.2195F},
    {50.0F, -0.001F, 2.49F, 50.0F, 0.0009F, -2.49F, 4.8045F},
    {50.0F, -0.001F, 2.49F, 50.0F, 0.0010F, -2.49F, 4.8045F},
    {50.0F, -0.001F, 2.49F, 50.0F, 0.0011F, -2.49F, 4.7461F},
    {50.0F, 2.5F, 0.0F, 50.0F, 0.0F, -2.5F, 4.3065F},
    {50.0F, 2.5F, 0.0F, 73.0F, 25.0F, -18.0F, 27.1492F},
    {50.0F, 2.5F, 0.0F, 61.0F, -5.0F, 29.0F, 22.8977F},
    {50.0F, 2.5F, 0.0F, 56.0F, -27.0F, -3.0F, 31.9030F},
    {50.0F, 2.5F, 0.0F, 58.0F, 24.0F, 15.0F, 19.4535F},
    {50.0F, 2.5F, 0.0F, 50.0F, 3.1736F, 0.5854F, 1.0F},
    {50.0F, 2.5F, 0.0F, 50.0F, 3.2972F, 0.0F, 1.0F},
    {50.0F, 2.5F, 0.0F, 50.0F, 1.8634F, 0.5757F, 1.0F},
    {50.0F, 2.5F, 0.0F, 50.0F, 3.2592F, 0.3350F, 1.0F},
    {60.2574F, -34.0099F, 36.2677F, 60.4626F, -34.1751F, 39.4387F, 1.2644F},
    {63.0109F, -31.0961F, -5.8663F, 62.8187F, -29.7946F, -4.0864F, 1.2630F},
    {61.2901F, 3.7196F, -5.3901F, 61.4292F, 2.2480F, -4.9620F, 1.8731F},
    {35.0831F, -44.1164F, 3.7933F, 35.0232F, -40.0716F, 1.5901F, 1.8645F},
    {22.7233F, 20.0904F, -46.6940F, 23.0331F, 14.9730F, -42.5619F, 2.0373F},
    {36.4612F, 47.8580F, 18.3852F, 36.2715F, 50.5065F, 21.2231F, 1.4146F},
    {90.8027F, -2.0831F, 1.4410F, 91.1528F, -1.6435F, 0.0447F, 1.4441F},
    {90.9257F, -0.5406F, -0.9208F, 88.6381F, -0.8985F, -0.7239F, 1.5381F},
    {6.7747F, -0.2908F, -2.4247F, 5.8714F, -0.0985F, -2.2286F, 0.6377F},
    {2.0776F, 0.0795F, -1.1350F, 0.9033F, -0.0636F, -0.5514F, 0.9082F},
}};

// Pairs 10 and 14 have hues exactly 180 degrees apart, where the formula is discontinuous and floats may fall
// on either side.
TEST(PerceptualColor, ciede2000IsThatOfThePublishedTable) {
  for (std::size_t i = 0; i < kPublished.size(); ++i) {
    if (i == 9 || i == 13) {
      continue;
    }
    const auto& [l1, a1, b1, l2, a2, b2, published] = kPublished[i];
    const float there = ciede2000({l1, a1, b1}, {l2, a2, b2});
    EXPECT_NEAR(there, published, 2e-4F) << i + 1;
    EXPECT_NEAR(ciede2000({l2, a2, b2}, {l1, a1, b1}), there, 1e-4F) << i + 1;
  }
}

Lab labOf(int red, int green, int blue) {
  const auto light = [](int value) { return lightOfSrgb(static_cast<float>(value) / 255); };
  return labOfLight({light(red), light(green), light(blue)});
}

// The commonly published values of sRGB's primaries, with the four digits of the standard's matrix.
TEST(PerceptualColor, labOfSrgb) {
  const auto near = [](const Lab& lab, float L, float a, float b) {
    EXPECT_NEAR(lab.L, L, 0.05F);
    EXPECT_NEAR(lab.a, a, 0.05F);
    EXPECT_NEAR(lab.b, b, 0.05F);
  };
  near(labOf(255, 255, 255), 100, 0, 0);
  near(labOf(0, 0, 0), 0, 0, 0);
  near(labOf(119, 119, 119), 50.03F, 0, 0);
  near(labOf(255, 0, 0), 53.24F, 80.09F, 67.20F);
  near(labOf(0, 255, 0), 87.73F, -86.18F, 83.18F);
  near(labOf(0, 0, 255), 32.30F, 79.19F, -107.86F);
}

// So differenceOf() loses next to nothing by skipping differences of one step.
TEST(PerceptualColor, coloursOneStepApartAreHardlyMoreThanVisiblyDifferent) {
  float most = 0;
  for (int red = 0; red < 255; red += 15) {
    for (int green = 0; green < 255; green += 15) {
      for (int blue = 0; blue < 255; blue += 15) {
        for (int step = 1; step < 27; ++step) {
          const int r = std::max(0, red + step % 3 - 1);
          const int g = std::max(0, green + step / 3 % 3 - 1);
          const int b = std::max(0, blue + step / 9 - 1);
          most = std::max(most, ciede2000(labOf(red, green, blue), labOf(r, g, b)));
        }
      }
    }
  }
  EXPECT_LT(static_cast<double>(most), 1.05 * kVisible);  // measured 2.35, in the darkest colours
  EXPECT_GT(most, 1);
}

}  // namespace
}  // namespace careen
