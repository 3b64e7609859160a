#include "physics/geometry/separating_axes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/tumbling_box.h"

namespace careen {
namespace {

using test::turned;

struct UnitCube {
  Pose pose;
  BoxAt at() const { return {pose, kHalf}; }
  static inline const Vec3 kHalf = Vec3(0.5, 0.5, 0.5);
};

double partingOf(const UnitCube& a, const UnitCube& b, const Vec3& velocity, double within) {
  const AxisSet axes = separatingAxes(a.at(), b.at(), within);
  return partingSpeed(directionsOf(axes, a.at(), b.at()), velocity);
}

// Edge on edge at 45°, each face leaning by as much: sideways is out along one face or the other.
TEST(SeparatingAxes, edgesThatPassEachOtherPart) {
  const Mat3 onEdge = turned<double>(Vec3::UnitZ(), std::acos(-1.0) / 4);
  const UnitCube a{.pose = {.position = Vec3(std::sqrt(2.0), 0, 0), .worldFromBody = onEdge}};
  const UnitCube b{.pose = {.position = Vec3::Zero(), .worldFromBody = onEdge}};
  const double within = touchingWithin(a.at(), b.at());
  const double lean = std::sqrt(0.5);
  for (const double side : {-1.0, 1.0}) {
    EXPECT_NEAR(partingOf(a, b, {0, side, 0.3}, within), lean, 1e-15);
    EXPECT_NEAR(partingOf(a, b, {-0.5, side, 0}, within), 0.5 * lean, 1e-15);
    EXPECT_NEAR(partingOf(a, b, {-1.5, side, 0}, within), -0.5 * lean, 1e-15);
    EXPECT_NEAR(partingOf(a, b, {0, 0, side}, within), 0, 1e-15);
  }
}

TEST(SeparatingAxes, facesHaveNone) {
  const UnitCube a{.pose = {.position = Vec3(0.3, 0.2, 1)}};
  const UnitCube b;
  EXPECT_EQ(separatingAxes(a.at(), b.at(), touchingWithin(a.at(), b.at())), 0U);
  EXPECT_TRUE(directionsOf(0, a.at(), b.at()).empty());
}

// A cube on a floor of cubes meets the edge of the next: up and back.
TEST(SeparatingAxes, ofLevelCubesAreUpAndBack) {
  const UnitCube a{.pose = {.position = Vec3(-1, 0.25, 1)}};
  const UnitCube b;
  const AxisSet axes = separatingAxes(a.at(), b.at(), touchingWithin(a.at(), b.at()));
  for (const Vec3& direction : directionsOf(axes, a.at(), b.at())) {
    EXPECT_TRUE(direction == Vec3(Vec3::UnitZ()) || direction == Vec3(-Vec3::UnitX())) << direction;
  }
  EXPECT_EQ(partingSpeed(directionsOf(axes, a.at(), b.at()), Vec3(2, 0, 0)), 0);
  EXPECT_EQ(partingSpeed(directionsOf(axes, a.at(), b.at()), Vec3(2, 0, -0.5)), -0.5);
}

TEST(SeparatingAxes, depthWithinTheGivenCountsAsNone) {
  const UnitCube a{.pose = {.position = Vec3(-1, 0, 1 - 1e-7)}};
  const UnitCube b;
  EXPECT_EQ(separatingAxes(a.at(), b.at(), 1e-8), 0U);
  EXPECT_EQ(partingOf(a, b, {2, 0, 0}, 1e-6), 0);
  EXPECT_EQ(partingOf(b, a, {-2, 0, 0}, 1e-6), 0);
}

// The same cubes, apart along both: neither is what keeps them apart more than the other.
TEST(SeparatingAxes, ofBoxesThatAreApartAreAllThatSeparate) {
  const UnitCube a{.pose = {.position = Vec3(-1.1, 0, 1.05)}};
  const UnitCube b;
  EXPECT_EQ(partingOf(a, b, {2, 0, 0}, 1e-9), 0);
}

TEST(SeparatingAxes, swappedBoxesHaveTheReversedDirections) {
  const Mat3 askew = turned<double>(Vec3(1, 2, 3).normalized(), 0.7);
  const UnitCube a{.pose = {.position = Vec3(0.9, 0.7, 1.1), .worldFromBody = askew}};
  const UnitCube b;
  for (int k = 0; k < BoxAxis::kCount; ++k) {
    const AxisSet one = 1U << k;
    EXPECT_EQ(swapped(swapped(one)), one);
    const Vec3 direction = directionsOf(one, a.at(), b.at()).front();
    EXPECT_NEAR((directionsOf(swapped(one), b.at(), a.at()).front() + direction).norm(), 0, 1e-15) << k;
  }
}

TEST(SeparatingAxes, ofThoseTheOneThatIsNotApproachedIsLeft) {
  const UnitCube a{.pose = {.position = Vec3(-1, 0.25, 1)}};
  const UnitCube b;
  const AxisSet both = separatingAxes(a.at(), b.at(), 1e-12);
  const auto left = [&](const Vec3& velocity) {
    return withoutApproached(both, a.at(), b.at(), velocity, 1e-12);
  };
  for (const Vec3& direction : directionsOf(left({1, 0, 0}), a.at(), b.at())) {
    EXPECT_EQ(direction, Vec3(Vec3::UnitZ()));
  }
  for (const Vec3& direction : directionsOf(left({0, 0, -1}), a.at(), b.at())) {
    EXPECT_EQ(direction, Vec3(-Vec3::UnitX()));
  }
  EXPECT_EQ(left({1, 0, -1}), both);
  EXPECT_EQ(left({-1, 0, 1}), both);
  EXPECT_EQ(left({1e-13, 0, 0}), both);
}

}  // namespace
}  // namespace careen
