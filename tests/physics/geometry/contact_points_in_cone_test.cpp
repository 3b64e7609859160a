#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "physics/geometry/contact_points.h"
#include "physics/world/body.h"
#include "support/tumbling_box.h"

// Contacts of which no part is a face: edge along edge, corner on edge, corner on corner.

namespace careen {
namespace {

using test::Dice;
using test::turned;

const double kHalfTurn = std::acos(-1.0);

struct Box {
  Pose pose;
  Vec3 half;
  BoxAt at() const { return {pose, half}; }
};
struct Pair {
  Box a;
  Box b;
  Vec3 normal;  // one that separates them, from b to a
  std::size_t points = 1;
};

// The farthest that a box reaches along n, from its centre: by its corners.
double reachOf(const Box& box, const Vec3& n) {
  double most = -1e30;
  for (int k = 0; k < kCorners; ++k) {
    most = std::max(most, n.dot(box.pose.worldFromBody * corner(box.half, k)));
  }
  return most;
}

// The middle of the part of a box that reaches farthest along n.
Vec3 farthestOf(const Box& box, const Vec3& n) {
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (int k = 0; k < kCorners; ++k) {
    const Vec3 arm = box.pose.worldFromBody * corner(box.half, k);
    if (n.dot(arm) >= reachOf(box, n) - 1e-9 * box.half.minCoeff()) {
      sum += arm;
      count += 1;
    }
  }
  return sum / count;
}

Vec3 shape(Dice& dice, int k) {
  const std::array<Vec3, 4> shapes = {Vec3(0.5, 0.3, 0.2), Vec3(0.4, 0.4, 0.4), Vec3(0.6, 0.4, 1e-2),
                                      Vec3(1, 1e-2, 1e-2)};
  return std::exp2(std::floor(dice.between(-4, 4))) * shapes.at(static_cast<std::size_t>(k % 4));
}

// Any attitude in which that axis is perpendicular to n.
Mat3 levelAttitude(Dice& dice, const Vec3& n, const Vec3& along, int axis) {
  Mat3 frame;
  frame.col(axis) = along;
  const double angle = dice.between(0.05, kHalfTurn / 2 - 0.05);
  const Vec3 across = along.cross(n);
  frame.col((axis + 1) % 3) = std::cos(angle) * n + std::sin(angle) * across;
  frame.col((axis + 2) % 3) = along.cross(frame.col((axis + 1) % 3));
  return frame;
}

Vec3 perpendicular(Dice& dice, const Vec3& n) {
  const Vec3 v = n.cross(dice.direction());
  return v.norm() > 0.1 ? Vec3(v.normalized()) : perpendicular(dice, n);
}

// Corners of two boxes, a corner and an edge, an edge and a corner, or two parallel edges, brought to touch.
Pair touchingPair(Dice& dice, int k) {
  Pair pair;
  pair.normal = dice.direction();
  const Vec3 along = perpendicular(dice, pair.normal);
  pair.a.half = shape(dice, k / 4);
  pair.b.half = shape(dice, k / 16);
  const int kind = k % 4;
  const bool edgeOfA = kind == 1 || kind == 3;
  const bool edgeOfB = kind == 2 || kind == 3;
  pair.a.pose.worldFromBody =
      edgeOfA ? levelAttitude(dice, -pair.normal, along, k / 64 % 3) : dice.orientation();
  pair.b.pose.worldFromBody =
      edgeOfB ? levelAttitude(dice, pair.normal, along, k / 192 % 3) : dice.orientation();
  pair.b.pose.position = dice.vector(1);
  const double onA = edgeOfA ? dice.between(-0.9, 0.9) * pair.a.half[k / 64 % 3] : 0;
  const double onB = edgeOfB ? dice.between(-0.9, 0.9) * pair.b.half[k / 192 % 3] : 0;
  const Vec3 point =
      pair.b.pose.position + farthestOf(pair.b, pair.normal) + onB * (edgeOfB ? along : Vec3(Vec3::Zero()));
  pair.a.pose.position = point - farthestOf(pair.a, -pair.normal) - onA * along;
  pair.points = kind == 3 ? 2 : 1;
  return pair;
}

// Whether two corners of a box are level along n, closer than what random attitudes should be asked to tell.
bool isDelicate(const Box& box, const Vec3& n) {
  const Vec3 along = box.pose.worldFromBody.transpose() * n;
  for (int i = 0; i < 3; ++i) {
    if (std::fabs(along[i]) < 1e-3 && std::fabs(along[i]) > 1e-13) {
      return true;
    }
  }
  return false;
}

// A box and its mirror image meet along the mirror's normal, whatever the attitude: by corners, or by edges.
TEST(ContactPointsInCone, ofMirrorImagesHaveTheNormalOfTheMirror) {
  Dice dice(61);
  double off = 0;
  double beside = 0;
  for (int k = 0; k < 6000; ++k) {
    const Vec3 mirror = dice.direction();
    const Mat3 reflection = Mat3::Identity() - 2 * mirror * mirror.transpose();
    Box a{.pose = {}, .half = shape(dice, k / 2)};
    const bool edge = k % 2 == 0;
    a.pose.worldFromBody =
        edge ? levelAttitude(dice, mirror, perpendicular(dice, mirror), k / 8 % 3) : dice.orientation();
    if (isDelicate(a, mirror)) {
      continue;
    }
    const Vec3 lateral = perpendicular(dice, mirror);
    a.pose.position = reachOf(a, -mirror) * mirror + dice.between(-1, 1) * lateral;
    // −1 times a reflected attitude is a rotation, and the same box.
    const Box b{.pose = {.position = reflection * a.pose.position,
                         .worldFromBody = -reflection * a.pose.worldFromBody},
                .half = a.half};
    const ContactPoints points = boxContactPoints(a.at(), b.at());
    ASSERT_EQ(points.size(), edge ? 2U : 1U) << k;
    for (const ContactPoint& point : points) {
      off = std::max(off, (point.normal - mirror).norm());
      beside = std::max(beside, std::fabs(mirror.dot(a.pose.position + point.armA)));
      beside = std::max(beside, std::fabs(mirror.dot(b.pose.position + point.armB)));
    }
  }
  EXPECT_LT(off, 1e-14);     // measured 9e-16
  EXPECT_LT(beside, 1e-14);  // measured 1.7e-15
}

// The corners' projections on the normal, of all 16, do not overlap; and the points lie on both boxes.
TEST(ContactPointsInCone, ofAnyPairSeparateIt) {
  Dice dice(62);
  double overlap = 0;
  double outside = 0;
  int pairs = 0;
  for (int k = 0; k < 8000; ++k) {
    const Pair pair = touchingPair(dice, k);
    if (isDelicate(pair.a, pair.normal) || isDelicate(pair.b, pair.normal)) {
      continue;
    }
    ++pairs;
    const double size = std::max(pair.a.half.norm(), pair.b.half.norm()) + 1;
    const ContactPoints points = boxContactPoints(pair.a.at(), pair.b.at());
    ASSERT_EQ(points.size(), pair.points) << k;
    for (const ContactPoint& point : points) {
      const double apart = point.normal.dot(pair.a.pose.position - pair.b.pose.position) -
                           reachOf(pair.a, -point.normal) - reachOf(pair.b, point.normal);
      ASSERT_NEAR(point.normal.norm(), 1, 1e-15);
      overlap = std::max(overlap, -apart / size);
      for (const auto& [box, arm] :
           {std::pair<const Box&, const Vec3&>{pair.a, point.armA}, {pair.b, point.armB}}) {
        const Vec3 place = (box.pose.worldFromBody.transpose() * arm).cwiseAbs() - box.half;
        outside = std::max(outside, place.maxCoeff() / size);
      }
      // Inside the cone, not on its border: every touching face leans away by some angle.
      for (const Box& box : {pair.a, pair.b}) {
        for (int i = 0; i < 3; ++i) {
          const double lean = std::fabs(box.pose.worldFromBody.col(i).dot(point.normal));
          ASSERT_LT(lean, 1 - 1e-8) << k;
        }
      }
    }
  }
  EXPECT_GT(pairs, 7000);
  EXPECT_LT(overlap, 1e-14);  // measured 4.8e-15
  EXPECT_LT(outside, 1e-14);  // measured 1.6e-15
}

// Bricks side by side on a floor, none quite level: fans narrower than rounding can resolve have no middle.
TEST(ContactPointsInCone, ofNearlyLevelBricksSeparateThem) {
  Dice dice(63);
  double overlap = 0;
  double outside = 0;
  for (int k = 0; k < 20000; ++k) {
    const auto nearlyLevel = [&dice](double yaw) {
      const double tilt = std::pow(10, dice.between(-13, -6));
      return Mat3(Eigen::AngleAxisd(tilt, perpendicular(dice, Vec3::UnitZ())).toRotationMatrix() *
                  Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix());
    };
    Box a{.pose = {}, .half = {0.2, 0.1, 0.1}};
    Box b = a;
    a.pose.worldFromBody = nearlyLevel(k % 2 == 0 ? 0 : dice.between(-0.05, 0.05));
    b.pose.worldFromBody = nearlyLevel(k % 3 == 0 ? 0 : dice.between(-0.05, 0.05));
    a.pose.position = {0.41, dice.between(-0.19, 0.19), 0};
    for (int pass = 0; pass < 4; ++pass) {
      const BoxAxes axes(a.at(), b.at());
      a.pose.position -= axes.gap() * axes.normal(axes.best());
    }
    for (const ContactPoint& point : boxContactPoints(a.at(), b.at())) {
      const double apart = point.normal.dot(a.pose.position - b.pose.position) - reachOf(a, -point.normal) -
                           reachOf(b, point.normal);
      overlap = std::max(overlap, -apart);
      for (const auto& [box, arm] : {std::pair<const Box&, const Vec3&>{a, point.armA}, {b, point.armB}}) {
        outside =
            std::max(outside, ((box.pose.worldFromBody.transpose() * arm).cwiseAbs() - box.half).maxCoeff());
      }
    }
  }
  EXPECT_LT(overlap, 1e-12);  // measured 1.1e-13, what counts as touching; 0.026 while such fans had a middle
  EXPECT_LT(outside, 1e-6);   // measured 3.4e-7: a corner past a face's end by what the tilt moves it
}

TEST(ContactPointsInCone, areTheSameToTheBitMirroredTurnedAndSwapped) {
  Dice dice(63);
  Mat3 mirror = Vec3(1, -1, 1).asDiagonal();
  Mat3 turn = Mat3::Zero();
  turn(0, 1) = -1;
  turn(1, 2) = 1;
  turn(2, 0) = -1;
  const auto image = [](const Mat3& map, const Box& box) {
    return Box{.pose = {.position = map * box.pose.position,
                        .worldFromBody = map.determinant() * map * box.pose.worldFromBody},
               .half = box.half};
  };
  const auto expectSame = [](const ContactPoints& points, const ContactPoints& others, const Mat3& map,
                             bool swapped) {
    ASSERT_EQ(points.size(), others.size());
    for (const ContactPoint& point : points) {
      const Vec3 arm = map * (swapped ? point.armB : point.armA);
      const Vec3 other = map * (swapped ? point.armA : point.armB);
      EXPECT_TRUE(std::any_of(others.begin(), others.end(), [&](const ContactPoint& at) {
        return at.armA == arm && at.armB == other &&
               at.normal == Vec3((swapped ? -1.0 : 1.0) * (map * point.normal));
      }));
    }
  };
  for (int k = 0; k < 3000 && !::testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    const Pair pair = touchingPair(dice, k);
    if (isDelicate(pair.a, pair.normal) || isDelicate(pair.b, pair.normal)) {
      continue;
    }
    const ContactPoints points = boxContactPoints(pair.a.at(), pair.b.at());
    expectSame(points, boxContactPoints(pair.b.at(), pair.a.at()), Mat3::Identity(), true);
    for (const Mat3& map : {mirror, turn}) {
      expectSame(points, boxContactPoints(image(map, pair.a).at(), image(map, pair.b).at()), map, false);
    }
  }
}

// A cube on its corner over a table's edge. Its faces rise from the corner at 54.7° to the vertical, t with
// cos t = 1/√3, one of its axes over the table's outside. In the vertical plane across the edge its normal
// cone reaches from t − 90° to t beyond the vertical, the table's from 0 to 90°: the middle is t/2.
TEST(ContactPointsInCone, ofACornerOverAnEdgeIsTheMiddleOfTheFan) {
  const double t = std::acos(std::sqrt(1.0 / 3));
  const double right = kHalfTurn / 2;
  const Box table{.pose = {}, .half = Vec3(1, 1, 1)};
  Mat3 onCorner;
  for (int i = 0; i < 3; ++i) {
    const double azimuth = i * 4 * right / 3;
    onCorner.col(i) = Vec3(std::sin(t) * std::cos(azimuth), std::sin(t) * std::sin(azimuth), std::cos(t));
  }
  Box cube{.pose = {.position = Vec3(1, 0.25, 1 + std::sqrt(3.0) / 2), .worldFromBody = onCorner},
           .half = Vec3(0.5, 0.5, 0.5)};
  const ContactPoints points = boxContactPoints(cube.at(), table.at());
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR((points[0].normal - Vec3(std::sin(t / 2), 0, std::cos(t / 2))).norm(), 0, 1e-15);
  EXPECT_NEAR((table.pose.position + points[0].armB - Vec3(1, 0.25, 1)).norm(), 0, 1e-15);
  // Beside the edge it stands on the face, or hangs beside the other.
  cube.pose.position.x() = 1 - 1e-9;
  EXPECT_EQ(boxContactPoints(cube.at(), table.at())[0].normal, Vec3(Vec3::UnitZ()));
}

// Two cubes side by side along a diagonal, as in a grid: the edge between them.
TEST(ContactPointsInCone, ofDiagonalNeighboursIsTheDiagonal) {
  const Box a{.pose = {.position = Vec3(0.5, 0, 0.5), .worldFromBody = Mat3::Identity()},
              .half = Vec3(0.25, 1, 0.25)};
  const Box b{.pose = {}, .half = Vec3(0.25, 0.5, 0.25)};
  const ContactPoints points = boxContactPoints(a.at(), b.at());
  ASSERT_EQ(points.size(), 2U);
  for (const ContactPoint& point : points) {
    EXPECT_NEAR((point.normal - Vec3(std::sqrt(0.5), 0, std::sqrt(0.5))).norm(), 0, 1e-15);
    EXPECT_EQ(point.armB.cwiseAbs(), b.half);
  }
}

// Two cards that lean on each other's top edges, ever steeper: the fan narrows to twice the angle between
// each card and the vertical, and its bisector stays level.
TEST(ContactPointsInCone, ofLeaningCardsIsLevelHoweverSteep) {
  const Vec3 half(0.005, 0.3, 0.5);
  for (const double lean : {0.5, 0.1, 1e-2, 1e-4, 1e-6, 1e-8}) {
    const Mat3 left = turned<double>(Vec3::UnitY(), lean);
    const Box a{.pose = {.position = Vec3(-std::sin(lean) * half.z() - std::cos(lean) * half.x(), 0, 0),
                         .worldFromBody = left},
                .half = half};
    const Box b{.pose = {.position = Vec3(-a.pose.position.x(), 0, 0),
                         .worldFromBody = turned<double>(Vec3::UnitY(), -lean)},
                .half = half};
    const ContactPoints points = boxContactPoints(a.at(), b.at());
    ASSERT_EQ(points.size(), 2U) << lean;
    EXPECT_NEAR((points[0].normal + Vec3::UnitX()).norm(), 0, 1e-15) << lean;
  }
}

}  // namespace
}  // namespace careen
