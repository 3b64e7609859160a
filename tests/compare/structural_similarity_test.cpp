#include "compare/structural_similarity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "pictures_to_compare.h"

namespace careen {
namespace {

/// One number per pixel, rows from the top.
struct SamplePlane {
  int width = 0;
  int height = 0;
  std::vector<float> values;

  std::span<const float> row(int y) const {
    return std::span(values).subspan(static_cast<std::size_t>(y) * static_cast<std::size_t>(width),
                                     static_cast<std::size_t>(width));
  }
  std::span<float> row(int y) {
    return std::span(values).subspan(static_cast<std::size_t>(y) * static_cast<std::size_t>(width),
                                     static_cast<std::size_t>(width));
  }
};

StructuralSimilarity similarityOf(const SamplePlane& one, const SamplePlane& other,
                                  const PixelMask& ignored = {}) {
  const RowReader read = [&](int y, std::span<float> rowOfOne, std::span<float> rowOfOther) {
    std::copy(one.row(y).begin(), one.row(y).end(), rowOfOne.begin());
    std::copy(other.row(y).begin(), other.row(y).end(), rowOfOther.begin());
  };
  return similarityOf(one.width, one.height, read, ignored);
}

SamplePlane planeOf(const Picture& picture) {
  SamplePlane plane{.width = picture.width, .height = picture.height, .values = {}};
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    plane.values.push_back(static_cast<float>(picture.rgb[i]));
  }
  return plane;
}

// Equation 13 of the paper, window by window, in doubles: weights by the Euclidean distance, variances in two
// passes.
StructuralSimilarity straightforward(const SamplePlane& one, const SamplePlane& other) {
  constexpr double kC1 = 6.5025;
  constexpr double kC2 = 58.5225;
  const auto reachOf = [](int size) { return std::min(5, (size - 1) / 2); };
  const int wide = reachOf(one.width);
  const int high = reachOf(one.height);
  const auto at = [](const SamplePlane& plane, int x, int y) {
    return static_cast<double>(plane.row(y)[static_cast<std::size_t>(x)]);
  };
  StructuralSimilarity result{.mean = 0, .worst = 2};
  int windows = 0;
  for (int y = high; y < one.height - high; ++y) {
    for (int x = wide; x < one.width - wide; ++x) {
      const auto mean = [&](auto&& value) {
        double sum = 0;
        double weights = 0;
        for (int v = -high; v <= high; ++v) {
          for (int u = -wide; u <= wide; ++u) {
            const double weight = std::exp(-(u * u + v * v) / (2 * 1.5 * 1.5));
            sum += weight * value(x + u, y + v);
            weights += weight;
          }
        }
        return sum / weights;
      };
      const double a = mean([&](int u, int v) { return at(one, u, v); });
      const double b = mean([&](int u, int v) { return at(other, u, v); });
      const double aa = mean([&](int u, int v) { return std::pow(at(one, u, v) - a, 2); });
      const double bb = mean([&](int u, int v) { return std::pow(at(other, u, v) - b, 2); });
      const double ab = mean([&](int u, int v) { return (at(one, u, v) - a) * (at(other, u, v) - b); });
      const double value = (2 * a * b + kC1) * (2 * ab + kC2) / ((a * a + b * b + kC1) * (aa + bb + kC2));
      result.mean += value;
      ++windows;
      if (value < result.worst) {
        result.worst = value;
        result.worstX = x;
        result.worstY = y;
      }
    }
  }
  result.mean /= windows;
  return result;
}

void expectAsStraightforward(const SamplePlane& one, const SamplePlane& other) {
  const StructuralSimilarity measured = similarityOf(one, other);
  const StructuralSimilarity expected = straightforward(one, other);
  EXPECT_NEAR(measured.mean, expected.mean, 2e-6);
  EXPECT_NEAR(measured.worst, expected.worst, 2e-5);
  EXPECT_EQ(measured.worstX, expected.worstX);
  EXPECT_EQ(measured.worstY, expected.worstY);
}

TEST(StructuralSimilarity, isThatOfThePapersFormulaWindowByWindow) {
  expectAsStraightforward(planeOf(noise(64, 48, 1)), planeOf(noise(64, 48, 2)));
  expectAsStraightforward(planeOf(shadedTiles(90, 70, 1)), planeOf(shadedTiles(90, 70, 5)));
  expectAsStraightforward(planeOf(shadedTiles(64, 48)), planeOf(noise(64, 48, 2)));
}

TEST(StructuralSimilarity, picturesSmallerThanTheWindowHaveASmallerOne) {
  for (const auto& [width, height] :
       {std::pair{1, 1}, {2, 2}, {3, 9}, {4, 30}, {30, 5}, {10, 10}, {11, 11}, {12, 3}}) {
    expectAsStraightforward(planeOf(noise(width, height, 1)), planeOf(noise(width, height, 2)));
  }
}

// Windows without any change are skipped, and count as 1.
TEST(StructuralSimilarity, changesInACornerAndInTheMiddleAreFound) {
  const SamplePlane plane = planeOf(shadedTiles(80, 60));
  for (const auto& [x, y] : {std::pair{0, 0}, {79, 59}, {40, 30}, {79, 0}, {6, 59}, {73, 20}}) {
    SamplePlane changed = plane;
    changed.values[static_cast<std::size_t>(y) * 80 + static_cast<std::size_t>(x)] += 90;
    expectAsStraightforward(plane, changed);
  }
}

// Windows are processed in ranges; none between two ranges is skipped, however far apart they are.
TEST(StructuralSimilarity, changesApartAreBothFound) {
  const SamplePlane plane = planeOf(shadedTiles(80, 24));
  for (int apart = 1; apart < 40; ++apart) {
    SamplePlane changed = plane;
    changed.values[std::size_t{12} * 80 + 20] += 30;
    changed.values[std::size_t{11} * 80 + 20 + static_cast<std::size_t>(apart)] += 90;
    expectAsStraightforward(plane, changed);
  }
}

TEST(StructuralSimilarity, isExactlyOneOfEqualPlanesAndFollowsFromMeansOfFlatOnes) {
  const SamplePlane plane = planeOf(noise(100, 80, 3));
  EXPECT_EQ(similarityOf(plane, plane).mean, 1);
  EXPECT_EQ(similarityOf(plane, plane).worst, 1);
  const double flatOnes = (2 * 100.0 * 150 + 6.5025) / (100.0 * 100 + 150.0 * 150 + 6.5025);
  EXPECT_NEAR(similarityOf(planeOf(flat(40, 40, 100)), planeOf(flat(40, 40, 150))).mean, flatOnes, 1e-6);
}

// Of windows centred on ignored pixels nothing is seen: the mean is that over the others.
TEST(StructuralSimilarity, windowsOfIgnoredPixelsDoNotCount) {
  const SamplePlane plane = planeOf(shadedTiles(40, 30));
  SamplePlane changed = plane;
  changed.values[std::size_t{10} * 40 + 12] += 90;
  const StructuralSimilarity all = similarityOf(plane, changed);
  // Windows that see the change are centred up to 5 px from it, so in x from 7 to 17.
  PixelMask mask{.width = 40, .ignored = std::vector<bool>(std::size_t{40} * 30)};
  for (std::size_t i = 0; i < mask.ignored.size(); ++i) {
    mask.ignored[i] = i % 40 >= 30;  // 5 columns of centres, 30 to 34, that see nothing of it
  }
  const StructuralSimilarity some = similarityOf(plane, changed, mask);
  EXPECT_NEAR(1 - some.mean, (1 - all.mean) * 30 / 25, 1e-12);
  EXPECT_EQ(some.worst, all.worst);
  for (std::size_t i = 0; i < mask.ignored.size(); ++i) {
    mask.ignored[i] = i % 40 >= 7 && i % 40 <= 17;
  }
  EXPECT_EQ(similarityOf(plane, changed, mask).mean, 1);
  EXPECT_EQ(similarityOf(plane, changed, mask).worst, 1);
  mask.ignored.assign(mask.ignored.size(), true);
  EXPECT_EQ(similarityOf(plane, changed, mask).mean, 1);
}

}  // namespace
}  // namespace careen
