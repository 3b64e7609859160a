#include "physics/geometry/separation.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "support/gap_oracle.h"

namespace careen {
namespace {

using test::Dice;
using test::TumblingBox;

const Mat3 kUpright = Mat3::Identity();

// A cube of edge 2 turned 45° about z, 5 m above the plane y = 1: lowest edge at √2 below its centre.
TEST(WallGap, isThatOfTheLowestEdge) {
  const Pose pose{.position = Vec3(7, 6, 3),
                  .worldFromBody = test::turned<double>(Vec3::UnitZ(), std::acos(-1.0) / 4)};
  const WallGap gap = wallGap({pose, Vec3(1, 1, 1)}, Vec3::UnitY(), 1, 1e-9);
  EXPECT_NEAR(gap.gap, 5 - std::sqrt(2.0), 1e-15);
  // Body corners (−,−,±): bits 2 and 1 set.
  EXPECT_EQ(gap.corners, 1U << 6U | 1U << 7U);
}

// A face tilted by less than the grouping tolerance strikes with all corners, by more with its edge.
TEST(WallGap, groupsCornersWithinTheTolerance) {
  const double within = kSimultaneous * std::sqrt(3.0);
  const auto corners = [&](double rise) {
    const Pose pose{.position = Vec3(0, 0, 1),
                    .worldFromBody = test::turned<double>(Vec3::UnitY(), rise / 2)};
    return std::popcount(wallGap({pose, Vec3(1, 1, 1)}, Vec3::UnitZ(), 0, within).corners);
  };
  EXPECT_EQ(corners(0.9 * within), 4);
  EXPECT_EQ(corners(1.1 * within), 2);
}

TEST(BoxAxes, alignedBoxesSeparateAlongTheWidestFace) {
  const BoxAxes axes(kUpright, Vec3(1, 1, 1), kUpright, Vec3(1, 2, 3), Vec3(-5, 3.5, 0));
  EXPECT_EQ(axes.gap(), 3);
  EXPECT_EQ(axes.best().kind(), BoxAxis::Kind::kFaceOfA);
  EXPECT_EQ(axes.normal(axes.best()), Vec3(-1, 0, 0));
}

TEST(BoxAxes, overlapIsNegativeByTheLeastDepth) {
  const BoxAxes axes(kUpright, Vec3(1, 1, 1), kUpright, Vec3(1, 1, 1), Vec3(1.75, 0.5, 0));
  EXPECT_EQ(axes.gap(), -0.25);
}

// Two edges at right angles over each other: cubes turned 45° about x and y, centres 2√2 + 0.1 apart along z.
TEST(BoxAxes, crossedEdgesSeparateAlongTheirCrossProduct) {
  const double quarter = std::acos(-1.0) / 4;
  const BoxAxes axes(test::turned<double>(Vec3::UnitX(), quarter), Vec3(1, 1, 1),
                     test::turned<double>(Vec3::UnitY(), quarter), Vec3(1, 1, 1),
                     Vec3(0, 0, 2 * std::sqrt(2.0) + 0.1));
  EXPECT_NEAR(axes.gap(), 0.1, 2e-15);
  EXPECT_EQ(axes.best().edgeOfA(), 0);
  EXPECT_EQ(axes.best().edgeOfB(), 1);
  EXPECT_NEAR(axes.normal(axes.best()).z(), 1, 1e-15);
}

TEST(BoxAxes, agreeWithTheCornersShadows) {
  Dice dice(41);
  double worst = 0;
  for (int k = 0; k < 5000; ++k) {
    TumblingBox a = test::tumblingBox(dice, Vec3(0.5, 0.3, 0.2), 0, 0);
    TumblingBox b = test::tumblingBox(dice, Vec3(1, 0.01, 0.4), 0, 0);
    a.position = dice.vector(1);
    const BoxAxes axes(a.start, a.halfExtents, b.start, b.halfExtents, a.position - b.position);
    worst = std::max(worst, std::fabs(axes.gap() - test::separation<double>(a, b, 0)));
    const BoxAxes swapped(b.start, b.halfExtents, a.start, a.halfExtents, b.position - a.position);
    ASSERT_EQ(axes.gap(), swapped.gap());
  }
  EXPECT_LT(worst, 1e-14);  // measured 1.1e-15
}

}  // namespace
}  // namespace careen
