#include "physics/pile/axes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/math/rotation.h"
#include "physics/geometry/separation.h"
#include "support/pile_scenes.h"
#include "support/tumbling_box.h"

namespace careen {
namespace {

PileBody boxAt(const Vec3& half, const Vec3& position, const Mat3& axes = Mat3::Identity()) {
  const Body body = makeBox({.halfExtents = half, .position = position, .worldFromBody = axes});
  return pileBody(body, body.initial);
}

constexpr double kFar = 100;

// Two cubes of half size 1, 3 m apart along x and 0.5 along y: 1 m along x, −1.5 along y.
TEST(PileAxes, byHand) {
  PileAxes axes{};
  ASSERT_TRUE(axes.find(boxAt(Vec3::Ones(), {3, 0.5, 0}), boxAt(Vec3::Ones(), Vec3::Zero()), kFar, -1, 0));
  EXPECT_EQ(axes.face, 0);
  EXPECT_EQ(axes.faceSeparation, 1);
  EXPECT_EQ(axes.apartA, Vec3(3, 0.5, 0));
  EXPECT_EQ(axes.apartB, Vec3(3, 0.5, 0));
  EXPECT_EQ(axes.edgeSeparation, 1);  // y × z: perpendicular edges span the faces' axes
}

// Faces of both and edges against the fifteen directions of geometry/, which takes all care.
TEST(PileAxes, agreeWithTheCarefulSeparations) {
  test::Dice dice(1);
  int byEdges = 0;
  for (int k = 0; k < 5000; ++k) {
    const PileBody a = boxAt({dice.between(0.1, 1), dice.between(0.1, 1), dice.between(0.1, 1)},
                             dice.vector(2), dice.orientation());
    const PileBody b = boxAt({dice.between(0.1, 1), dice.between(0.1, 1), dice.between(0.1, 1)},
                             dice.vector(2), dice.orientation());
    const BoxAxes careful(a.axes, a.halfExtents, b.axes, b.halfExtents, a.position - b.position);
    double face = std::numeric_limits<double>::lowest();
    double edge = face;
    for (int i = 0; i < BoxAxis::kCount; ++i) {
      if (i < 6) {
        face = std::max(face, careful.separation({i}));
      } else if (careful.sine((i - 6) / 3, (i - 6) % 3) > 0x1p-7) {
        edge = std::max(edge, careful.separation({i}));
      }
    }
    PileAxes axes{};
    ASSERT_TRUE(axes.find(a, b, kFar, -1, 0));
    EXPECT_NEAR(axes.faceSeparation, face, 1e-14);
    EXPECT_NEAR(axes.edgeSeparation, edge, 2e-13);
    EXPECT_NEAR(careful.separation({axes.face}), face, 1e-14);
    EXPECT_NEAR(careful.separation({axes.edges}), edge, 2e-13);
    EXPECT_LT((axes.cosines - a.axes.transpose() * b.axes).norm(), 1e-15);
    for (int i = 0; i < BoxAxis::kCount; ++i) {
      if (i < 6 || careful.sine((i - 6) / 3, (i - 6) % 3) > 0x1p-6) {
        EXPECT_NEAR(separationAlong(i, a, b, a.position - b.position), careful.separation({i}), 2e-13);
      }
    }
    byEdges += edge > face ? 1 : 0;
  }
  EXPECT_GT(byEdges, 100);
}

// Gives up exactly where some axis separates by more than it reaches, and tells how far.
TEST(PileAxes, giveUpAtBoxesOutOfReach) {
  test::Dice dice(2);
  int gaveUp = 0;
  for (int k = 0; k < 5000; ++k) {
    const PileBody a = boxAt({0.3, 0.4, 0.5}, dice.vector(1.5), dice.orientation());
    const PileBody b = boxAt({0.5, 0.2, 0.4}, Vec3::Zero(), dice.orientation());
    PileAxes all{};
    ASSERT_TRUE(all.find(a, b, kFar, -1, 0));
    const double widest = std::max(all.faceSeparation, all.edgeSeparation);
    PileAxes near{};
    const double reach = 0.1;
    EXPECT_EQ(near.find(a, b, reach, -1, 0), widest <= reach);
    if (widest > reach) {
      ++gaveUp;
      EXPECT_GT(near.faceSeparation, reach);
      EXPECT_LE(near.faceSeparation, widest);
    }
  }
  EXPECT_GT(gaveUp, 1000);
}

// Separations of −0.4 along x and −0.45 along y: the last axis stays within the tie of 0.1, not within 0.01.
TEST(PileAxes, theLastAxisWinsTies) {
  const PileBody a = boxAt(Vec3::Ones(), {1.6, 1.55, 0});
  const PileBody b = boxAt(Vec3::Ones(), Vec3::Zero());
  for (const auto& [last, tie, expected] :
       {std::tuple{-1, 0.1, 0}, {1, 0.1, 1}, {1, 0.01, 0}, {4, 0.1, 4}, {2, 0.1, 0}}) {
    PileAxes axes{};
    ASSERT_TRUE(axes.find(a, b, kFar, last, tie));
    EXPECT_EQ(axes.face, expected) << last << ' ' << tie;
    EXPECT_NEAR(axes.faceSeparation, expected % 3 == 0 ? -0.4 : -0.45, 1e-15) << "without the tie";
  }
}

// Whichever axis is tried first: the gap, or a lower bound of it above what is asked for.
TEST(GapAbove, isTheGapOrABoundAboveTheLeast) {
  test::Dice dice(3);
  int bounds = 0;
  int gaps = 0;
  for (int k = 0; k < 5000; ++k) {
    const PileBody a = boxAt({0.3, 0.4, 0.5}, dice.vector(1), dice.orientation());
    const PileBody b = boxAt({0.5, 0.2, 0.4}, Vec3::Zero(), dice.orientation());
    PileAxes axes{};
    ASSERT_TRUE(axes.find(a, b, kFar, -1, 0));
    const double least = dice.between(-0.2, 0.2);
    for (int first = -1; first < BoxAxis::kCount; ++first) {
      const double found = gapAboveOfBoxes(least, first, a, b);
      if (axes.separation() > least) {
        EXPECT_GT(found, least);
        EXPECT_LE(found, axes.separation() + 2e-13);
        bounds += found < axes.separation() - 1e-3 ? 1 : 0;
      } else {
        EXPECT_EQ(found, axes.separation());
        ++gaps;
      }
    }
    const int best = axes.edgeSeparation > axes.faceSeparation ? axes.edges : axes.face;
    EXPECT_NEAR(gapAboveOfBoxes(-kFar, best, a, b), axes.separation(), 2e-13);
  }
  EXPECT_GT(bounds, 1000);
  EXPECT_GT(gaps, 1000);
}

}  // namespace
}  // namespace careen
