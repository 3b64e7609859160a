#include "physics/pile/clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "core/math/rotation.h"
#include "support/article_equations.h"
#include "support/pile_scenes.h"
#include "support/tumbling_box.h"

namespace careen {
namespace {

PileBody clippedBoxAt(const Vec3& half, const Vec3& position, const Mat3& axes = Mat3::Identity()) {
  const Body body = makeBox({.halfExtents = half, .position = position, .worldFromBody = axes});
  return pileBody(body, body.initial);
}

ClippedFace clipped(const PileBody& owner, const PileBody& incident, int axis, double sign,
                    double slack = 0) {
  return clipFace(owner, incident, owner.axes.transpose() * incident.axes,
                  owner.axes.transpose() * (incident.position - owner.position), axis, sign, slack);
}

std::vector<ClippedPoint> pointsOf(const ClippedFace& face) {
  return {face.points.begin(), face.points.begin() + face.count};
}

// The area of its shadow on the plane, by the shoelace formula; positive whichever way round.
double areaOf(const ClippedFace& face, int axis) {
  double twice = 0;
  const std::vector<ClippedPoint> points = pointsOf(face);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3& a = points[k].point;
    const Vec3& b = points[(k + 1) % points.size()].point;
    twice += a[(axis + 1) % 3] * b[(axis + 2) % 3] - a[(axis + 2) % 3] * b[(axis + 1) % 3];
  }
  return std::fabs(twice) / 2;
}

// A box of 0.4 × 0.6 m, 1 mm above a plate: its own four corners.
TEST(Clip, keepsAFaceThatLiesWithinTheOther) {
  const PileBody plate = clippedBoxAt({1, 1, 0.5}, Vec3::Zero());
  const PileBody box = clippedBoxAt({0.2, 0.3, 0.25}, {0.1, 0.2, 0.751});
  const ClippedFace face = clipped(plate, box, 2, 1);
  ASSERT_EQ(face.count, 4);
  for (const ClippedPoint& point : pointsOf(face)) {
    EXPECT_NEAR(point.gap, 0.001, 1e-15);
    EXPECT_NEAR(std::fabs(point.point.x() - 0.1), 0.2, 1e-15);
    EXPECT_NEAR(std::fabs(point.point.y() - 0.2), 0.3, 1e-15);
    EXPECT_NEAR(point.point.z(), 0.501, 1e-15);
  }
}

// Hanging over by half: x from 0.5 to 1, the two new corners on the plate's edge.
TEST(Clip, cutsWhatHangsOver) {
  const PileBody plate = clippedBoxAt({1, 1, 0.5}, Vec3::Zero());
  const PileBody box = clippedBoxAt({0.5, 0.25, 0.25}, {1, 0, 0.75});
  const ClippedFace face = clipped(plate, box, 2, 1);
  ASSERT_EQ(face.count, 4);
  EXPECT_NEAR(areaOf(face, 2), 0.5 * 0.5, 1e-15);
  EXPECT_NEAR(areaOf(clipped(plate, box, 2, 1, 0.125), 2), 0.625 * 0.5, 1e-15) << "with slack";
  // On the other side there is nothing of it but its shadow, as far up as it is.
  const ClippedFace below = clipped(plate, box, 2, -1);
  EXPECT_NEAR(below.points[0].gap, -0.5 - 0.5 - 0.5, 1e-15);
}

TEST(Clip, ofFacesBesideEachOtherIsNothing) {
  EXPECT_EQ(
      clipped(clippedBoxAt(Vec3::Ones(), Vec3::Zero()), clippedBoxAt(Vec3::Ones(), {2.5, 0, 2}), 2, 1).count,
      0);
}

// A square turned by 45° over an equal one: a regular octagon of area 8 (√2 − 1) in units of half sizes.
TEST(Clip, ofTurnedSquaresIsAnOctagon) {
  const PileBody below = clippedBoxAt(Vec3::Ones(), Vec3::Zero());
  const PileBody above = clippedBoxAt(Vec3::Ones(), {0, 0, 2}, axisAngle(Vec3::UnitZ(), std::atan(1.0)));
  const ClippedFace face = clipped(below, above, 2, 1);
  ASSERT_EQ(face.count, 8);
  EXPECT_NEAR(areaOf(face, 2), 8 * (std::sqrt(2.0) - 1), 1e-14);
  std::set<std::uint32_t> features;
  for (const ClippedPoint& point : pointsOf(face)) {
    EXPECT_NEAR(point.point.head<2>().norm(), std::sqrt(1 + std::pow(std::sqrt(2.0) - 1, 2)), 1e-15);
    features.insert(point.feature);
    // Where an edge of one crosses an edge of the other: of the incident face 0…3, of the plane's 4…7.
    EXPECT_NE(point.feature / 8 < 4, point.feature % 8 < 4) << point.feature;
  }
  EXPECT_EQ(features.size(), 8U) << "each corner has its own";
}

// Features name edges, not places: they stay when boxes slide a little, and faces tell which two touch.
TEST(Clip, featuresStayWhileTheSameEdgesCross) {
  const PileBody below = clippedBoxAt(Vec3::Ones(), Vec3::Zero());
  const ClippedFace before =
      clipped(below, clippedBoxAt(Vec3::Ones(), {0.5, 0.3, 2}, axisAngle(Vec3::UnitZ(), 0.3)), 2, 1);
  const ClippedFace after =
      clipped(below, clippedBoxAt(Vec3::Ones(), {0.51, 0.29, 2.01}, axisAngle(Vec3::UnitZ(), 0.31)), 2, 1);
  ASSERT_EQ(before.count, after.count);
  EXPECT_EQ(before.faces, after.faces);
  for (int k = 0; k < before.count; ++k) {
    EXPECT_EQ(before.points[static_cast<std::size_t>(k)].feature,
              after.points[static_cast<std::size_t>(k)].feature);
  }
  EXPECT_NE(clipped(below, clippedBoxAt(Vec3::Ones(), {0, 0, -2}), 2, -1).faces, before.faces);
}

// Every corner lies on the incident face and within the owner's sides, and the area is that of a grid count.
TEST(Clip, isTheCommonPartOfBothShadows) {
  test::Dice dice(3);
  int cut = 0;
  for (int k = 0; k < 400; ++k) {
    const PileBody owner = clippedBoxAt({dice.between(0.3, 1), dice.between(0.3, 1), dice.between(0.3, 1)},
                                        dice.vector(1), dice.orientation());
    const PileBody incident = clippedBoxAt({dice.between(0.3, 1), dice.between(0.3, 1), dice.between(0.3, 1)},
                                           owner.position + dice.vector(1), dice.orientation());
    const int axis = k % 3;
    const double sign = k % 2 == 0 ? 1 : -1;
    const ClippedFace face = clipped(owner, incident, axis, sign);
    const int side = static_cast<int>(face.faces % 8);
    const double faceSign = side % 2 == 1 ? 1 : -1;
    for (const ClippedPoint& point : pointsOf(face)) {
      EXPECT_LT(std::fabs(point.point[(axis + 1) % 3]), owner.halfExtents[(axis + 1) % 3] + 1e-14);
      EXPECT_LT(std::fabs(point.point[(axis + 2) % 3]), owner.halfExtents[(axis + 2) % 3] + 1e-14);
      EXPECT_NEAR(point.gap, sign * point.point[axis] - owner.halfExtents[axis], 1e-15);
      const Vec3 world = owner.position + owner.axes * point.point;
      const Vec3 local = incident.axes.transpose() * (world - incident.position);
      EXPECT_NEAR(local[side / 2], faceSign * incident.halfExtents[side / 2], 1e-14);
      for (int i = 0; i < 3; ++i) {
        EXPECT_LT(std::fabs(local[i]), incident.halfExtents[i] + 1e-14);
      }
    }
    // The face looks most against the owner's.
    const Vec3 outward = sign * owner.axes.col(axis);
    for (int i = 0; i < 3; ++i) {
      EXPECT_LE(faceSign * outward.dot(incident.axes.col(side / 2)),
                -std::fabs(outward.dot(incident.axes.col(i))) + 1e-15);
    }
    // Points of the incident face on a fine grid, counted where they lie over the owner's face.
    constexpr int kGrid = 60;
    int within = 0;
    const int i1 = (side / 2 + 1) % 3;
    const int i2 = (side / 2 + 2) % 3;
    for (int u = 0; u < kGrid; ++u) {
      for (int v = 0; v < kGrid; ++v) {
        Vec3 local = Vec3::Zero();
        local[side / 2] = faceSign * incident.halfExtents[side / 2];
        local[i1] = incident.halfExtents[i1] * ((2 * u + 1.0) / kGrid - 1);
        local[i2] = incident.halfExtents[i2] * ((2 * v + 1.0) / kGrid - 1);
        const Vec3 point =
            owner.axes.transpose() * (incident.position + incident.axes * local - owner.position);
        within += std::fabs(point[(axis + 1) % 3]) <= owner.halfExtents[(axis + 1) % 3] &&
                          std::fabs(point[(axis + 2) % 3]) <= owner.halfExtents[(axis + 2) % 3]
                      ? 1
                      : 0;
      }
    }
    const double cosine = std::fabs(outward.dot(incident.axes.col(side / 2)));
    const double whole = 4 * incident.halfExtents[i1] * incident.halfExtents[i2] * cosine;
    EXPECT_NEAR(areaOf(face, axis), whole * within / (kGrid * kGrid), 0.03 * whole);
    cut += within > 0 && within < kGrid * kGrid ? 1 : 0;
  }
  EXPECT_GT(cut, 200);
}

}  // namespace
}  // namespace careen
