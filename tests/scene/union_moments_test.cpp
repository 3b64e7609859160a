#include "scene/union_moments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace careen {
namespace {

class AnyParts {
 public:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 vector(double most) { return {between(-most, most), between(-most, most), between(-most, most)}; }
  Mat3 rotation() {
    return Quat(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1))
        .normalized()
        .toRotationMatrix();
  }
  std::vector<BodyPart> aligned(int count) {
    std::vector<BodyPart> parts;
    for (int k = 0; k < count; ++k) {
      parts.push_back({.halfExtents = Vec3(between(0.1, 0.5), between(0.1, 0.5), between(0.1, 0.5)),
                       .center = vector(0.5)});
    }
    return parts;
  }

 private:
  std::mt19937 engine_{5};
};

// All parts turned about the origin.
std::vector<BodyPart> turned(std::vector<BodyPart> parts, const Mat3& by) {
  for (BodyPart& part : parts) {
    part.turned = true;
    part.bodyFromPart = by;  // its centre is in its own frame
  }
  return parts;
}

// Of boxes along the axes, by the cells of the grid that all their faces make.
SolidMoments byCells(const std::vector<BodyPart>& parts) {
  std::array<std::vector<double>, 3> planes;
  for (const BodyPart& part : parts) {
    for (int axis = 0; axis < 3; ++axis) {
      planes.at(static_cast<std::size_t>(axis)).push_back(part.center[axis] - part.halfExtents[axis]);
      planes.at(static_cast<std::size_t>(axis)).push_back(part.center[axis] + part.halfExtents[axis]);
    }
  }
  for (std::vector<double>& along : planes) {
    std::sort(along.begin(), along.end());
  }
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (std::size_t i = 1; i < planes[0].size(); ++i) {
    for (std::size_t j = 1; j < planes[1].size(); ++j) {
      for (std::size_t k = 1; k < planes[2].size(); ++k) {
        const Vec3 low(planes[0][i - 1], planes[1][j - 1], planes[2][k - 1]);
        const Vec3 high(planes[0][i], planes[1][j], planes[2][k]);
        const Vec3 middle = 0.5 * (low + high);
        const bool isIn = std::any_of(parts.begin(), parts.end(), [&](const BodyPart& part) {
          return ((middle - part.center).cwiseAbs().array() < part.halfExtents.array()).all();
        });
        if (isIn) {
          const Vec3 half = 0.5 * (high - low);
          const double cell = 8 * half.prod();
          volume += cell;
          first += cell * middle;
          second += cell * (middle * middle.transpose());
          second.diagonal() += cell / 3 * half.cwiseAbs2();
        }
      }
    }
  }
  const Vec3 center = first / volume;
  const Mat3 spread = second - volume * (center * center.transpose());
  return {.volume = volume, .center = center, .inertia = spread.trace() * Mat3::Identity() - spread};
}

TEST(UnionMoments, ofBoxesAlongTheAxesAreTheSumOverCells) {
  AnyParts any;
  double worst = 0;
  for (int k = 0; k < 300; ++k) {
    const std::vector<BodyPart> parts = any.aligned(1 + k % 6);
    const SolidMoments found = momentsOfUnion(parts);
    const SolidMoments expected = byCells(parts);
    worst = std::max({worst, std::fabs(found.volume / expected.volume - 1),
                      (found.center - expected.center).norm(),
                      (found.inertia - expected.inertia).norm() / expected.inertia.norm()});
  }
  EXPECT_LT(worst, 2e-14);  // measured 9e-15
}

TEST(UnionMoments, turnWithTheBoxes) {
  AnyParts any;
  double worst = 0;
  for (int k = 0; k < 200; ++k) {
    const std::vector<BodyPart> parts = any.aligned(1 + k % 6);
    const Mat3 by = any.rotation();
    const SolidMoments found = momentsOfUnion(turned(parts, by));
    const SolidMoments expected = byCells(parts);
    worst = std::max(
        {worst, std::fabs(found.volume / expected.volume - 1), (found.center - by * expected.center).norm(),
         (found.inertia - by * expected.inertia * by.transpose()).norm() / expected.inertia.norm()});
  }
  EXPECT_LT(worst, 2e-14);  // measured 7e-15
}

// A square column and one turned by 45° about its axis share that of a regular octagon, of area 8 (√2 − 1).
TEST(UnionMoments, countWhatBoxesThatAreTurnedShareOnce) {
  const Mat3 eighth = Quat(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitZ())).toRotationMatrix();
  const std::vector<BodyPart> star = {{.halfExtents = Vec3(1, 1, 2)},
                                      {.halfExtents = Vec3(1, 1, 2), .turned = true, .bodyFromPart = eighth}};
  const SolidMoments found = momentsOfUnion(star);
  const double shared = 8 * (std::sqrt(2.0) - 1);
  EXPECT_NEAR(found.volume, 4 * (2 * 4 - shared), 1e-13);
  EXPECT_EQ(found.center, Vec3::Zero());
  // About the axis: two squares of side a = 2, a⁴/6 each, less the octagon, in 16 right triangles.
  const double half = std::tan(std::numbers::pi / 8);  // half its side, at distance 1
  const double octagon = 16 * (half / 4 + half * half * half / 12);
  EXPECT_NEAR(found.inertia(2, 2), 4 * (2 * 16.0 / 6 - octagon), 1e-13);
}

TEST(UnionMoments, ofEightBoxesInOneAreThoseOfThatToTheBit) {
  const Vec3 half(0.3, 0.25, 0.7);
  std::vector<BodyPart> parts;
  for (int k = 0; k < kCorners; ++k) {
    parts.push_back({.halfExtents = 0.5 * half, .center = 0.5 * corner(half, k)});
  }
  const SolidMoments found = momentsOfUnion(parts);
  const double volume = 8 * half.prod();
  EXPECT_EQ(found.volume, volume);
  EXPECT_EQ(found.center, Vec3::Zero());
  EXPECT_EQ(found.inertia, Mat3(solidBox(half, volume).inertiaBody.asDiagonal()));
  EXPECT_EQ(reachOf(parts), half);
}

TEST(UnionMoments, ofAPartWithinAnotherAreThatOfTheOther) {
  const std::vector<BodyPart> both = {{.halfExtents = Vec3(0.1, 0.1, 0.1), .center = Vec3(0.2, 0, 0)},
                                      {.halfExtents = Vec3(0.5, 0.4, 0.3)}};
  EXPECT_EQ(momentsOfUnion(both).volume, 8 * 0.5 * 0.4 * 0.3);
}

}  // namespace
}  // namespace careen
