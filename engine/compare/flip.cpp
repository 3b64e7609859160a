#include "compare/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <string>

#include "compare/perceptual_color.h"
#include "core/error.h"

namespace careen {
namespace {

constexpr double kPi = std::numbers::pi;

struct Grid {
  int width;
  int height;
  std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

using Values = std::vector<float>;
using Vec = std::array<float, 3>;

/// A separable filter: its weights along one direction, from -reach to reach.
using Taps = std::vector<float>;

// Filters rows, then columns; the border pixels are repeated outward.
Values filtered(const Values& values, Grid grid, const Taps& across, const Taps& down) {
  const auto width = static_cast<std::size_t>(grid.width);
  const int reach = static_cast<int>(across.size() / 2);
  Values rows(values.size());
  Values padded(width + 2 * static_cast<std::size_t>(reach));
  for (int y = 0; y < grid.height; ++y) {
    const float* const row = values.data() + static_cast<std::size_t>(y) * width;
    std::fill_n(padded.begin(), reach, row[0]);
    std::copy_n(row, width, padded.begin() + reach);
    std::fill_n(padded.end() - reach, reach, row[width - 1]);
    float* const out = rows.data() + static_cast<std::size_t>(y) * width;
    for (std::size_t tap = 0; tap < across.size(); ++tap) {
      for (std::size_t x = 0; x < width; ++x) {
        out[x] += across[tap] * padded[x + tap];
      }
    }
  }
  Values result(values.size());
  for (int y = 0; y < grid.height; ++y) {
    float* const out = result.data() + static_cast<std::size_t>(y) * width;
    for (int tap = -reach; tap <= reach; ++tap) {
      const float weight = *(down.begin() + tap + reach);
      const float* const row =
          rows.data() + static_cast<std::size_t>(std::clamp(y + tap, 0, grid.height - 1)) * width;
      for (std::size_t x = 0; x < width; ++x) {
        out[x] += weight * row[x];
      }
    }
  }
  return result;
}

// Linear light to CIE XYZ relative to white, and back: the matrix of IEC 61966-2-1 with more digits, whose
// white is that of the paper's constants.
constexpr std::array<std::array<double, 3>, 3> kXyzOfRgb{
    {{0.4123865632529916, 0.35759149092062537, 0.18045049120356368},
     {0.21263682167732384, 0.7151829818412507, 0.07218019648142547},
     {0.01933062033992418, 0.11919716364020845, 0.950372587005435}}};
constexpr std::array<std::array<double, 3>, 3> kRgbOfXyz{
    {{3.241003232976358, -1.537398969488785, -0.498615881996363},
     {-0.969224252202516, 1.875929983695176, 0.041554226340085},
     {0.055639419851975, -0.204011206123910, 1.057148977187533}}};

using Matrix = std::array<std::array<double, 3>, 3>;

Vec times(const Matrix& matrix, const Vec& v) {
  Vec result{};
  for (std::size_t i = 0; i < 3; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      sum += matrix[i][k] * static_cast<double>(v[k]);
    }
    result[i] = static_cast<float>(sum);
  }
  return result;
}

Vec whiteXyz() { return times(kXyzOfRgb, {1, 1, 1}); }

/// Linearized CIELAB of the paper, 3.1.1: Y with offset, and two opponent chromas.
Vec opponentOfLight(const Vec& rgb) {
  static const Vec kWhite = whiteXyz();
  const Vec xyz = times(kXyzOfRgb, rgb);
  const float x = xyz[0] / kWhite[0];
  const float y = xyz[1] / kWhite[1];
  const float z = xyz[2] / kWhite[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Vec lightOfOpponent(const Vec& v) {
  static const Vec kWhite = whiteXyz();
  const float y = (v[0] + 16) / 116;
  return times(kRgbOfXyz, {(y + v[1] / 500) * kWhite[0], y * kWhite[1], (y - v[2] / 200) * kWhite[2]});
}

/// CIELAB whose chromas are reduced in the dark: 3.2, Hunt effect.
Vec huntLab(const Vec& light) {
  static const Vec kWhite = whiteXyz();
  const Vec xyz = times(kXyzOfRgb, light);
  const Lab lab = labOfXyz({xyz[0] / kWhite[0], xyz[1] / kWhite[1], xyz[2] / kWhite[2]});
  return {lab.L, 0.01F * lab.L * lab.a, 0.01F * lab.L * lab.b};
}

/// The distance for large differences of 3.2, to the power q_c.
float colorDistance(const Vec& one, const Vec& other) {
  return std::pow(std::abs(one[0] - other[0]) + std::hypot(one[1] - other[1], one[2] - other[2]), 0.7F);
}

/// Remaps distances so that small differences use most of 0 … 1: 3.3, p_c and p_t; the largest distance is
/// that of green and blue.
float spread(float distance) {
  static const float kLargest = colorDistance(huntLab({0, 1, 0}), huntLab({0, 0, 1}));
  constexpr float kBend = 0.95F;
  const float knee = 0.4F * kLargest;
  return distance < knee ? distance * kBend / knee
                         : kBend + (distance - knee) / (kLargest - knee) * (1 - kBend);
}

/// One Gaussian of a contrast sensitivity function: a √(π/b) exp(-π² x²/b), x in degrees; table 1.
struct Sensitivity {
  double a;
  double b;
};
constexpr Sensitivity kAchromatic{1, 0.0047};
constexpr Sensitivity kRedGreen{1, 0.0053};
constexpr std::array<Sensitivity, 2> kBlueYellow{{{34.1, 0.04}, {13.5, 0.025}}};

int sensitivityReach(double pixelsPerDegree) {
  return static_cast<int>(std::ceil(3 * std::sqrt(kBlueYellow[0].b / (2 * kPi * kPi)) * pixelsPerDegree));
}

/// The weights along one direction, not normalized; the square of their sum is the sum of the 2D filter.
std::vector<double> gaussian(double b, double pixelsPerDegree) {
  const int reach = sensitivityReach(pixelsPerDegree);
  std::vector<double> weights;
  for (int i = -reach; i <= reach; ++i) {
    const double degrees = i / pixelsPerDegree;
    weights.push_back(std::exp(-kPi * kPi * degrees * degrees / b));
  }
  return weights;
}

double sumOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) {
    sum += value;
  }
  return sum;
}

Taps scaled(const std::vector<double>& values, double factor) {
  Taps taps;
  for (const double value : values) {
    taps.push_back(static_cast<float>(factor * value));
  }
  return taps;
}

Values filteredBySensitivity(const Values& values, Grid grid, const Sensitivity& sensitivity,
                             double pixelsPerDegree) {
  const std::vector<double> weights = gaussian(sensitivity.b, pixelsPerDegree);
  const Taps taps = scaled(weights, 1 / sumOf(weights));
  return filtered(values, grid, taps, taps);
}

/// The sum of two Gaussians is not separable, but each of them is; their shares follow from their sums.
Values filteredBySensitivity(const Values& values, Grid grid, const std::array<Sensitivity, 2>& pair,
                             double pixelsPerDegree) {
  std::array<double, 2> shares{};
  for (std::size_t i = 0; i < 2; ++i) {
    const double sum = sumOf(gaussian(pair[i].b, pixelsPerDegree));
    shares[i] = pair[i].a * std::sqrt(kPi / pair[i].b) * sum * sum;
  }
  Values first = filteredBySensitivity(values, grid, pair[0], pixelsPerDegree);
  const Values second = filteredBySensitivity(values, grid, pair[1], pixelsPerDegree);
  const auto share = static_cast<float>(shares[0] / (shares[0] + shares[1]));
  for (std::size_t i = 0; i < first.size(); ++i) {
    first[i] = share * first[i] + (1 - share) * second[i];
  }
  return first;
}

/// A picture in the opponent space of 3.1.1, one plane per channel.
using Opponent = std::array<Values, 3>;

Opponent opponentOf(const DeepPicture& picture) {
  Opponent channels;
  const std::size_t pixels = picture.samples() / static_cast<std::size_t>(picture.channels);
  const float full = picture.deep ? 65535.0F : 255.0F;
  const auto sample = [&picture, full](std::size_t place) {
    const int value = picture.deep ? picture.samples16[place] : picture.samples8[place];
    return static_cast<float>(value) / full;
  };
  const bool alpha = picture.channels == 4;
  const float grey = picture.deep ? 32767.0F / 65535.0F : 127.0F / 255.0F;
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::size_t place = i * static_cast<std::size_t>(picture.channels);
    const float opacity = alpha ? sample(place + 3) : 1;
    Vec light{};
    for (std::size_t k = 0; k < 3; ++k) {
      light[k] = lightOfSrgb(opacity * sample(place + k) + (1 - opacity) * grey);
    }
    const Vec opponent = opponentOfLight(light);
    for (std::size_t k = 0; k < 3; ++k) {
      channels[k].push_back(opponent[k]);
    }
  }
  return channels;
}

/// The perceived picture at that distance, in Hunt-adjusted L*a*b*: 3.1 and 3.2.
std::vector<Vec> perceived(const Opponent& picture, Grid grid, double pixelsPerDegree) {
  const Values y = filteredBySensitivity(picture[0], grid, kAchromatic, pixelsPerDegree);
  const Values x = filteredBySensitivity(picture[1], grid, kRedGreen, pixelsPerDegree);
  const Values z = filteredBySensitivity(picture[2], grid, kBlueYellow, pixelsPerDegree);
  std::vector<Vec> colors;
  for (std::size_t i = 0; i < y.size(); ++i) {
    Vec light = lightOfOpponent({y[i], x[i], z[i]});
    for (float& value : light) {
      value = std::clamp(value, 0.0F, 1.0F);
    }
    colors.push_back(huntLab(light));
  }
  return colors;
}

/// A derivative of a Gaussian along one direction; its positive weights sum to 1, its negative ones to -1.
Taps derivative(const std::vector<double>& weights) {
  double positive = 0;
  double negative = 0;
  for (const double weight : weights) {
    (weight > 0 ? positive : negative) += std::abs(weight);
  }
  Taps taps;
  for (const double weight : weights) {
    taps.push_back(static_cast<float>(weight / (weight > 0 ? positive : negative)));
  }
  return taps;
}

/// Strength of edges and points at each pixel: 3.4, of luminance 0 … 1.
struct Features {
  Values edges;
  Values points;
};

Features featuresOf(const Opponent& picture, Grid grid, double pixelsPerDegree) {
  const double sigma = 0.5 * 0.082 * pixelsPerDegree;  // w: width of a feature, in degrees
  const int reach = static_cast<int>(std::ceil(3 * sigma));
  std::vector<double> gauss;
  std::vector<double> slope;
  std::vector<double> bend;
  for (int i = -reach; i <= reach; ++i) {
    gauss.push_back(std::exp(-i * i / (2 * sigma * sigma)));
    slope.push_back(-i * gauss.back());
    bend.push_back((i * i / (sigma * sigma) - 1) * gauss.back());
  }
  Values luminance(picture[0].size());
  std::transform(picture[0].begin(), picture[0].end(), luminance.begin(),
                 [](float y) { return (y + 16) / 116; });
  const Taps even = scaled(gauss, 1 / sumOf(gauss));
  const auto strength = [&](const Taps& taps) {
    const Values across = filtered(luminance, grid, taps, even);
    Values result = filtered(luminance, grid, even, taps);
    for (std::size_t i = 0; i < result.size(); ++i) {
      result[i] = std::hypot(result[i], across[i]);
    }
    return result;
  };
  return {strength(derivative(slope)), strength(derivative(bend))};
}

}  // namespace

Flip flipOf(const DeepPicture& expected, const DeepPicture& actual, double pixelsPerDegree,
            const PixelMask& ignored) {
  requireOneSize(expected, actual);
  const Grid grid{expected.width, expected.height};
  if (grid.size() > kMostPixelsOfFlip) {
    throw InputError("--flip: found pictures of " + std::to_string(grid.size()) +
                     " pixels, expected at most " + std::to_string(kMostPixelsOfFlip));
  }
  const Opponent one = opponentOf(expected);
  const Opponent other = opponentOf(actual);
  const std::vector<Vec> colorsOne = perceived(one, grid, pixelsPerDegree);
  const std::vector<Vec> colorsOther = perceived(other, grid, pixelsPerDegree);
  const Features featuresOne = featuresOf(one, grid, pixelsPerDegree);
  const Features featuresOther = featuresOf(other, grid, pixelsPerDegree);
  Flip flip;
  double sum = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const float color = spread(colorDistance(colorsOne[i], colorsOther[i]));
    const float feature = std::max(std::abs(featuresOne.edges[i] - featuresOther.edges[i]),
                                   std::abs(featuresOne.points[i] - featuresOther.points[i]));
    const float seenFeature = std::sqrt(std::numbers::sqrt2_v<float> / 2 * feature);  // q_f = 1/2
    flip.values.push_back(std::pow(color, 1 - seenFeature));
    if (ignored.empty() || !ignored.ignored[i]) {
      sum += static_cast<double>(flip.values.back());
      flip.largest = std::max(flip.largest, static_cast<double>(flip.values.back()));
    }
  }
  flip.mean = sum / static_cast<double>(grid.size() - ignored.count);
  return flip;
}

}  // namespace careen
