#include "compare/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/error.h"
#include "pictures_to_compare.h"

namespace careen {
namespace {

using Color = std::array<double, 3>;
constexpr double kPi = std::numbers::pi;

// The paper's pipeline implemented again, in doubles, with 2D filters evaluated point by point, and colours
// from the standard's chromaticities: it shares nothing with the tested code.
class Straightforward {
 public:
  Straightforward(const DeepPicture& one, const DeepPicture& other, double ppd)
      : width_(one.width), height_(one.height), ppd_(ppd) {
    const std::vector<Color> a = opponents(one);
    const std::vector<Color> b = opponents(other);
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const double color = redistributed(distance(seen(a, x, y), seen(b, x, y)));
        const double feature =
            std::max(std::abs(edge(a, x, y) - edge(b, x, y)), std::abs(point(a, x, y) - point(b, x, y)));
        values.push_back(std::pow(color, 1 - std::sqrt(feature / std::sqrt(2.0))));
      }
    }
  }
  std::vector<double> values;

 private:
  // X, Y, Z of the primaries of BT.709 and white D65 at x = 0.3127, y = 0.3290, solved by Cramer's rule.
  static std::array<Color, 3> primaries() {
    const std::array<std::array<double, 2>, 3> xy{{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}}};
    std::array<Color, 3> p{};
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = {xy[i][0] / xy[i][1], 1, (1 - xy[i][0] - xy[i][1]) / xy[i][1]};
    }
    const Color white{0.3127 / 0.3290, 1, (1 - 0.3127 - 0.3290) / 0.3290};
    const Color scale = solved(p, white);
    for (std::size_t i = 0; i < 3; ++i) {
      for (double& value : p[i]) {
        value *= scale[i];
      }
    }
    return p;
  }
  static double determinant(const Color& a, const Color& b, const Color& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) +
           c[0] * (a[1] * b[2] - a[2] * b[1]);
  }
  static Color solved(const std::array<Color, 3>& p, const Color& v) {
    const double all = determinant(p[0], p[1], p[2]);
    return {determinant(v, p[1], p[2]) / all, determinant(p[0], v, p[2]) / all,
            determinant(p[0], p[1], v) / all};
  }
  static Color xyzOf(const Color& rgb) {
    static const std::array<Color, 3> kPrimaries = primaries();
    Color xyz{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        xyz[k] += rgb[i] * kPrimaries[i][k];
      }
    }
    return xyz;
  }
  static Color overWhite(const Color& rgb) {
    const Color xyz = xyzOf(rgb);
    const Color white = xyzOf({1, 1, 1});
    return {xyz[0] / white[0], xyz[1] / white[1], xyz[2] / white[2]};
  }
  static Color opponent(const Color& v) {
    return {116 * v[1] - 16, 500 * (v[0] - v[1]), 200 * (v[1] - v[2])};
  }
  static Color hunt(const Color& rgb) {
    Color v = overWhite(rgb);
    for (double& t : v) {
      t = t > std::pow(6.0 / 29, 3) ? std::cbrt(t) : t * 841 / 108 + 4.0 / 29;
    }
    const Color lab = opponent(v);
    return {lab[0], 0.01 * lab[0] * lab[1], 0.01 * lab[0] * lab[2]};
  }
  static double distance(const Color& one, const Color& other) {
    const double hyab = std::abs(one[0] - other[0]) +
                        std::sqrt(std::pow(one[1] - other[1], 2) + std::pow(one[2] - other[2], 2));
    return std::pow(hyab, 0.7);
  }
  static double redistributed(double value) {
    const double most = distance(hunt({0, 1, 0}), hunt({0, 0, 1}));
    return value < 0.4 * most ? 0.95 / (0.4 * most) * value
                              : 0.95 + (value - 0.4 * most) / (most - 0.4 * most) * 0.05;
  }

  std::vector<Color> opponents(const DeepPicture& picture) const {
    std::vector<Color> colors;
    for (std::size_t i = 0; i < picture.samples8.size(); i += 3) {
      Color light{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double s = picture.samples8[i + k] / 255.0;
        light[k] = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
      }
      colors.push_back(opponent(overWhite(light)));
    }
    return colors;
  }
  const Color& at(const std::vector<Color>& picture, int x, int y) const {
    const auto row = static_cast<std::size_t>(std::clamp(y, 0, height_ - 1));
    const auto column = static_cast<std::size_t>(std::clamp(x, 0, width_ - 1));
    return picture[row * static_cast<std::size_t>(width_) + column];
  }
  Color seen(const std::vector<Color>& picture, int x, int y) const {
    const std::array<std::array<double, 4>, 3> table{
        {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}}};
    const int reach = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * ppd_));
    Color sum{};
    Color weights{};
    for (int v = -reach; v <= reach; ++v) {
      for (int u = -reach; u <= reach; ++u) {
        const double d = (u * u + v * v) / (ppd_ * ppd_);
        for (std::size_t k = 0; k < 3; ++k) {
          const auto& [a1, b1, a2, b2] = table[k];
          const double g = a1 * std::sqrt(kPi / b1) * std::exp(-kPi * kPi * d / b1) +
                           a2 * std::sqrt(kPi / b2) * std::exp(-kPi * kPi * d / b2);
          sum[k] += g * at(picture, x + u, y + v)[k];
          weights[k] += g;
        }
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      sum[k] /= weights[k];
    }
    const double luminance = (sum[0] + 16) / 116;
    const Color white = xyzOf({1, 1, 1});
    Color light = solved(primaries(), {(luminance + sum[1] / 500) * white[0], luminance * white[1],
                                       (luminance - sum[2] / 200) * white[2]});
    for (double& value : light) {
      value = std::clamp(value, 0.0, 1.0);
    }
    return hunt(light);
  }
  // |(G_x * Y, G_y * Y)| for a derivative of a Gaussian whose positive part sums to 1 and negative to -1.
  double gradient(const std::vector<Color>& picture, int x, int y,
                  const std::function<double(int, double)>& along) const {
    const double sigma = 0.5 * 0.082 * ppd_;
    const int reach = static_cast<int>(std::ceil(3 * sigma));
    double positive = 0;
    double negative = 0;
    std::array<double, 4> sums{};  // across and down, of positive and of negative weights
    for (int v = -reach; v <= reach; ++v) {
      for (int u = -reach; u <= reach; ++u) {
        const double g = along(u, sigma) * std::exp(-(u * u + v * v) / (2 * sigma * sigma));
        const double across = (at(picture, x + u, y + v)[0] + 16) / 116;
        const double down = (at(picture, x + v, y + u)[0] + 16) / 116;
        (g > 0 ? positive : negative) += std::abs(g);
        sums[g > 0 ? 0 : 1] += g * across;
        sums[g > 0 ? 2 : 3] += g * down;
      }
    }
    return std::hypot(sums[0] / positive + sums[1] / negative, sums[2] / positive + sums[3] / negative);
  }
  double edge(const std::vector<Color>& picture, int x, int y) const {
    return gradient(picture, x, y, [](int u, double) { return static_cast<double>(-u); });
  }
  double point(const std::vector<Color>& picture, int x, int y) const {
    return gradient(picture, x, y, [](int u, double sigma) { return u * u / (sigma * sigma) - 1; });
  }

  int width_;
  int height_;
  double ppd_;
};

// The two matrices differ in the fifth digit; noise maximises the effect.
void expectAsStraightforward(const DeepPicture& one, const DeepPicture& other, double ppd) {
  const Flip flip = flipOf(one, other, ppd);
  const Straightforward expected(one, other, ppd);
  double worst = 0;
  double mean = 0;
  for (std::size_t i = 0; i < expected.values.size(); ++i) {
    worst = std::max(worst, std::abs(expected.values[i] - static_cast<double>(flip.values[i])));
    mean += expected.values[i] / static_cast<double>(expected.values.size());
  }
  EXPECT_LT(worst, 2e-3) << ppd;
  EXPECT_NEAR(flip.mean, mean, 2e-4) << ppd;
}

TEST(Flip, isThatOfThePapersEquations) {
  expectAsStraightforward(BoxPicture{.left = 8.3, .top = 6.5, .size = 14}.draw(40, 30),
                          BoxPicture{.left = 10.3, .top = 6.5, .size = 14}.draw(40, 30), kPixelsPerDegree);
  expectAsStraightforward(deepPicture(noise(30, 24, 1)), deepPicture(noise(30, 24, 2)), kPixelsPerDegree);
  expectAsStraightforward(deepPicture(shadedTiles(40, 30)), deepPicture(noise(40, 30, 2)), 30);
}

TEST(Flip, isNothingOfEqualPictures) {
  const DeepPicture picture = deepPicture(noise(40, 30, 1));
  const Flip flip = flipOf(picture, picture);
  EXPECT_EQ(flip.mean, 0);
  EXPECT_EQ(flip.largest, 0);
  EXPECT_EQ(flip.values.size(), 1200U);
}

// Where all is flat no filter does anything, and there are no features: HyAB alone. White and black are 100
// apart: 100^0.7 = 25.12. Green (87.73, -86.18, 83.18) and blue (32.30, 79.19, -107.86), a and b times L/100
// as Hunt would, are 55.43 + |(-101.19, 107.81)| = 203.3 apart: 41.27. The knee is at 0.4 of that, 16.51, and
// white beside black 0.95 + 0.05 (25.12 - 16.51) / (41.27 - 16.51) = 0.9674. Green beside blue is 1 by
// definition.
TEST(Flip, flatPicturesFollowFromTheEquationsByHand) {
  const DeepPicture black = flatPicture(40, 30, 0, 0, 0);
  const Flip flip = flipOf(black, flatPicture(40, 30, 255, 255, 255));
  EXPECT_NEAR(flip.mean, 0.9674, 2e-4);
  EXPECT_NEAR(flip.largest, flip.mean, 1e-4);
  EXPECT_NEAR(flipOf(flatPicture(40, 30, 0, 255, 0), flatPicture(40, 30, 0, 0, 255)).mean, 1, 1e-4);
}

TEST(Flip, seesLessFromFarAwayAndOrderDoesNotMatter) {
  const DeepPicture one = deepPicture(noise(60, 40, 1));
  const DeepPicture other = deepPicture(noise(60, 40, 9));
  EXPECT_GT(flipOf(one, other, 20).mean, 1.3 * flipOf(one, other, 100).mean);
  EXPECT_EQ(flipOf(one, other).mean, flipOf(other, one).mean);
  EXPECT_THROW(flipOf(one, deepPicture(flat(61, 40, 1))), InputError);
}

TEST(Flip, ignoredPixelsCountInNeitherMeanNorLargest) {
  const DeepPicture expected = flatPicture(20, 10, 100, 100, 100);
  DeepPicture actual = expected;
  actual.samples8[0] = 255;
  const Flip all = flipOf(expected, actual);
  IgnoredRegions regions;
  regions.add("0,0,10,10");
  const Flip some = flipOf(expected, actual, kPixelsPerDegree, regions.of(20, 10));
  double sum = 0;
  for (std::size_t i = 0; i < all.values.size(); ++i) {
    sum += i % 20 >= 10 ? static_cast<double>(all.values[i]) : 0;
  }
  EXPECT_NEAR(some.mean, sum / 100, 1e-12);
  EXPECT_LT(some.largest, all.largest);
}

TEST(Flip, picturesTooLargeForItAreRefused) {
  const DeepPicture large{.width = 8193, .height = 8192, .samples8 = {}, .samples16 = {}};
  EXPECT_THROW(flipOf(large, large), InputError);
}

}  // namespace
}  // namespace careen
