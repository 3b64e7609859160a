#include "physics/search/time_of_impact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <cmath>
#include <vector>

#include "support/gap_oracle.h"
#include "support/tumbling_box.h"

namespace careen {
namespace {

using test::Dice;
using test::heightOverWall;
using test::Meeting;
using test::meeting;
using test::Plane;
using test::roomFlight;
using test::separation;
using test::TumblingBox;
using Quad = boost::multiprecision::cpp_bin_float_quad;

constexpr double kHorizon = 2;

std::vector<Plane> room(double half) {
  std::vector<Plane> walls;
  for (int axis = 0; axis < 3; ++axis) {
    walls.push_back({.normal = Vec3::Unit(axis), .offset = -half});
    walls.push_back({.normal = -Vec3::Unit(axis), .offset = -half});
  }
  return walls;
}

// Root of a falling function near `guess`, to 2⁻⁶⁰ of the bracket.
template <class Gap>
Quad rootNear(const Gap& gap, double guess) {
  Quad low = Quad(guess) - Quad(1e-7);
  Quad high = Quad(guess) + Quad(1e-7);
  EXPECT_GT(gap(low), 0);
  EXPECT_LT(gap(high), 0);
  for (int i = 0; i < 55; ++i) {
    const Quad middle = (low + high) / 2;
    (gap(middle) > 0 ? low : high) = middle;
  }
  return low;
}

struct RoomHit {
  FirstContact contact;
  Plane wall;
};

RoomHit firstInRoom(const TumblingBox& box, const std::vector<Plane>& walls) {
  const MovingBox moving = box.moving();
  RoomHit first{.contact = {}, .wall = walls.front()};
  first.contact.time = kHorizon;
  for (const Plane& wall : walls) {
    const FirstContact hit =
        firstContactWithWall(moving, wall.normal, wall.offset, {.from = 0, .until = first.contact.time});
    if (hit.kind != ContactKind::kNone) {
      first = {.contact = hit, .wall = wall};
    }
  }
  return first;
}

TEST(TimeOfImpact, neverMissesAWallIn2000Flights) {
  Dice dice(1);
  const std::vector<Plane> walls = room(2.8);
  int impacts = 0;
  double deepest = 1;
  double atImpact = 0;
  for (int k = 0; k < 2000; ++k) {
    const TumblingBox box = roomFlight(dice, k);
    const RoomHit hit = firstInRoom(box, walls);
    impacts += hit.contact.kind == ContactKind::kImpact ? 1 : 0;
    for (int sample = 0; sample < 2000; ++sample) {
      const double t = hit.contact.time * sample / 2000;
      for (const Plane& wall : walls) {
        deepest = std::min(deepest, heightOverWall<double>(box, wall, t));
      }
    }
    if (hit.contact.kind != ContactKind::kNone) {
      atImpact = std::max(atImpact, std::fabs(heightOverWall<double>(box, hit.wall, hit.contact.time)));
    }
  }
  EXPECT_GT(impacts, 1500);
  EXPECT_GE(deepest, -1e-14);  // measured 0 for walls, 5e-5 for boxes: none is late
  EXPECT_LE(atImpact, 1e-13);  // measured 3.6e-15 and 2.7e-15, bullets at 1000 m/s included
}

TEST(TimeOfImpact, ofAWallIsGoodToRounding) {
  Dice dice(2);
  const std::vector<Plane> walls = room(2.8);
  double worst = 0;
  int measured = 0;
  for (int k = 0; k < 400; ++k) {
    const TumblingBox box = roomFlight(dice, 4 * k);
    const RoomHit hit = firstInRoom(box, walls);
    if (hit.contact.kind != ContactKind::kImpact || hit.contact.approach < 0.5) {
      continue;
    }
    const Quad root =
        rootNear([&](const Quad& t) { return heightOverWall<Quad>(box, hit.wall, t); }, hit.contact.time);
    worst = std::max(worst, std::fabs(static_cast<double>(root - Quad(hit.contact.time))));
    ++measured;
  }
  EXPECT_GT(measured, 250);
  EXPECT_LT(worst, 2e-15);  // measured 2.8e-16
}

TEST(TimeOfImpact, neverMissesABoxIn2000Flights) {
  Dice dice(3);
  int impacts = 0;
  int misses = 0;
  double deepest = 1;
  double atImpact = 0;
  int evaluations = 0;
  int most = 0;
  for (int k = 0; k < 2000; ++k) {
    const Meeting pair = meeting(dice, k);
    const FirstContact hit =
        firstContactOfBoxes(pair.a.moving(), pair.b.moving(), {.from = 0, .until = kHorizon});
    impacts += hit.kind == ContactKind::kImpact ? 1 : 0;
    misses += hit.kind == ContactKind::kNone ? 1 : 0;
    evaluations += hit.evaluations;
    most = std::max(most, hit.evaluations);
    for (int sample = 0; sample < 2000; ++sample) {
      const double t = hit.time * sample / 2000;
      const double radii = pair.a.halfExtents.norm() + pair.b.halfExtents.norm();
      if ((pair.a.centre(t) - pair.b.centre(t)).squaredNorm() < radii * radii) {
        deepest = std::min(deepest, separation<double>(pair.a, pair.b, t));
      }
    }
    if (hit.kind != ContactKind::kNone) {
      atImpact = std::max(atImpact, std::fabs(separation<double>(pair.a, pair.b, hit.time)));
    }
  }
  EXPECT_GT(impacts, 1000);
  EXPECT_GT(misses, 100);
  EXPECT_LT(evaluations, 2000 * 15);  // measured 9.0 per pair
  EXPECT_LT(most, 200);               // measured 34
  EXPECT_GE(deepest, -1e-14);         // measured 0 for walls, 5e-5 for boxes: none is late
  EXPECT_LE(atImpact, 1e-13);         // measured 3.6e-15 and 2.7e-15, bullets at 1000 m/s included
}

TEST(TimeOfImpact, ofTwoBoxesIsGoodToRounding) {
  Dice dice(4);
  double worst = 0;
  int measured = 0;
  for (int k = 0; measured < 60 && k < 1000; ++k) {
    const Meeting pair = meeting(dice, k);
    const FirstContact hit =
        firstContactOfBoxes(pair.a.moving(), pair.b.moving(), {.from = 0, .until = kHorizon});
    if (hit.kind != ContactKind::kImpact || hit.approach < 0.5) {
      continue;
    }
    const Quad root = rootNear([&](const Quad& t) { return separation<Quad>(pair.a, pair.b, t); }, hit.time);
    worst = std::max(worst, std::fabs(static_cast<double>(root - Quad(hit.time))));
    ++measured;
  }
  EXPECT_LT(worst, 2e-15);  // measured 2.3e-16
}

// Long edges that cross at angles from 0.1 down to 1e-15: the direction between them is ill-conditioned,
// their gap is not. In cross-section corner meets corner, within the angle times the length: there only the
// edges' own direction separates to the end.
TEST(TimeOfImpact, ofNearlyParallelEdgesIsGoodToRounding) {
  Dice dice(5);
  double worst = 0;
  int edges = 0;
  int most = 0;
  const Vec3 across = Vec3(0, 1, 1).normalized();
  for (int k = 0; k < 90; ++k) {
    const double tilt = std::pow(10, -1 - k % 15);
    // Turned anyhow in the world, so that no component is zero and every product rounds.
    const Mat3 anyhow = dice.orientation();
    const Vec3 towards = anyhow * across;
    TumblingBox a{.halfExtents = Vec3(1, 0.2, 0.2), .velocity = 2 * towards};
    a.start = anyhow * test::turned<double>(Vec3::UnitX(), dice.between(0.05, 0.2));
    TumblingBox b{.halfExtents = Vec3(1, 0.2, 0.2), .position = anyhow * Vec3(0.1, 1, 1)};
    const Vec3 tiltAxis = (towards + dice.vector(0.2)).normalized();
    const double roll = dice.between(-0.2, -0.05);
    b.start = test::turned<double>(tiltAxis, tilt) * anyhow * test::turned<double>(Vec3::UnitX(), roll);
    b.momentumAxis = dice.direction();
    b.precession = k % 2 == 0 ? 0 : tilt;
    const Vec3 meetAt = b.position + b.orientation(0.5) * Vec3(0, -0.2, -0.2);
    a.position = meetAt - a.start * Vec3(0, 0.2, 0.2) - 0.5 * a.velocity +
                 anyhow * Vec3(dice.between(-0.5, 0.5), 0.1 * tilt, -0.1 * tilt);
    const FirstContact hit = firstContactOfBoxes(a.moving(), b.moving(), {.from = 0, .until = kHorizon});
    ASSERT_EQ(hit.kind, ContactKind::kImpact);
    edges += hit.axis.index == 6 ? 1 : 0;
    most = std::max(most, hit.evaluations);
    const Quad root = rootNear([&](const Quad& t) { return separation<Quad>(a, b, t); }, hit.time);
    worst = std::max(worst, std::fabs(static_cast<double>(root - Quad(hit.time))));
  }
  EXPECT_GT(edges, 70);
  EXPECT_LE(most, 20);      // measured 6
  EXPECT_LT(worst, 2e-15);  // measured 3.1e-16
}

}  // namespace
}  // namespace careen
