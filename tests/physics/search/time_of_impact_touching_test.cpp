#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <cmath>

#include "physics/search/time_of_impact.h"
#include "support/gap_oracle.h"

namespace careen {
namespace {

using test::Dice;
using test::heightOverWall;
using test::Meeting;
using test::meeting;
using test::Plane;
using test::ReversedBox;
using test::roomFlight;
using test::separation;
using test::TumblingBox;
using Quad = boost::multiprecision::cpp_bin_float_quad;

const Plane kFloor{.normal = Vec3::UnitZ(), .offset = 0};
const Vec3 kHalf(0.5, 0.25, 0.125);
const Vec3 kGravity(0, 0, -8);

FirstContact onFloor(const TumblingBox& box, double until) {
  return firstContactWithWall(box.moving(), kFloor.normal, kFloor.offset, {.from = 0, .until = until});
}

// ½·8·t² = 1: t = 1/2, to the bit.
TEST(Touching, aBoxDroppedFlatStrikesWithFourCornersAtTheClosedFormsTime) {
  const FirstContact hit =
      onFloor({.halfExtents = kHalf, .position = Vec3(3, 1, 1.125), .gravity = kGravity}, 10);
  EXPECT_EQ(hit.kind, ContactKind::kImpact);
  EXPECT_EQ(hit.time, 0.5);
  EXPECT_EQ(hit.approach, 4);
  EXPECT_EQ(hit.corners, 0b10101010U);
}

TEST(Touching, whatLeavesIsLetGoAndComesBackAfterAHop) {
  const FirstContact hit = onFloor(
      {.halfExtents = kHalf, .position = Vec3(0, 0, 0.125), .velocity = Vec3(1, 0, 2), .gravity = kGravity},
      10);
  EXPECT_EQ(hit.kind, ContactKind::kImpact);
  EXPECT_NEAR(hit.time, 0.5, 1e-16);
}

TEST(Touching, whatClosesFromNoGapStrikesAtOnce) {
  const FirstContact hit =
      onFloor({.halfExtents = kHalf, .position = Vec3(0, 0, 0.125), .velocity = Vec3(1, 0, -2)}, 10);
  EXPECT_EQ(hit.kind, ContactKind::kImpact);
  EXPECT_EQ(hit.time, 0);
}

// Two corners that lie 1e-11 m in the floor rise while the other two, on its surface, come down at 0.3 m/s:
// these strike when they are as deep as the others were. Were it at once, the impact, of which they are too
// high to take part, would be found for ever.
TEST(Touching, otherCornersStrikeWhereTheyAreAsDeep) {
  const FirstContact hit = onFloor({.halfExtents = kHalf,
                                    .position = Vec3(0, 0, 0.125 - 5e-12),
                                    .velocity = Vec3(0, 0, 0.2),
                                    .start = test::turned<double>(Vec3::UnitY(), -1e-11),
                                    .momentumAxis = Vec3::UnitY(),
                                    .precession = 1},
                                   10);
  EXPECT_EQ(hit.kind, ContactKind::kImpact);
  EXPECT_NEAR(hit.time, 1e-11 / 0.3, 1e-14);
}

TEST(Touching, whatRestsOrTipsIsTouching) {
  EXPECT_EQ(onFloor({.halfExtents = kHalf, .position = Vec3(0, 0, 0.125), .gravity = kGravity}, 10).kind,
            ContactKind::kTouching);
  // On an edge, about to tip: the corners' speed is zero, their acceleration is not.
  const FirstContact edge = onFloor({.halfExtents = kHalf,
                                     .position = Vec3(0, 0, (kHalf.x() + kHalf.z()) * std::sqrt(0.5)),
                                     .gravity = kGravity,
                                     .start = test::turned<double>(Vec3::UnitY(), std::acos(-1.0) / 4)},
                                    10);
  EXPECT_EQ(edge.kind, ContactKind::kTouching);
  EXPECT_EQ(edge.time, 0);
}

TEST(Touching, whatSlidesWithoutWeightNeverTouches) {
  const FirstContact hit =
      onFloor({.halfExtents = kHalf, .position = Vec3(0, 0, 0.125), .velocity = Vec3(1, 0, 0)}, 1e6);
  EXPECT_EQ(hit.kind, ContactKind::kNone);
  EXPECT_EQ(hit.time, 1e6);
  EXPECT_LT(hit.evaluations, 5);
}

// A top that spins flat on the floor without weight: the gap stays zero; no bound can tell, so it ends.
TEST(Touching, aGapThatStaysZeroEndsAsTouching) {
  const FirstContact hit =
      onFloor({.halfExtents = kHalf, .position = Vec3(0, 0, 0.125), .precession = 5}, 1e6);
  EXPECT_EQ(hit.kind, ContactKind::kTouching);
  EXPECT_EQ(hit.time, 0);
}

TEST(Touching, anOverlapIsLetGoWhileItOpensAndStrikesWhenItCloses) {
  TumblingBox box{.halfExtents = kHalf, .position = Vec3(0, 0, 0.1), .velocity = Vec3(0, 0, 1)};
  EXPECT_EQ(onFloor(box, 10).kind, ContactKind::kNone);
  box.velocity.z() = -1;
  EXPECT_EQ(onFloor(box, 10).kind, ContactKind::kImpact);
  EXPECT_EQ(onFloor(box, 10).time, 0);
}

TEST(Touching, aBoxOnABoxRestsAndABoxFallingFlatOnABoxStrikes) {
  const TumblingBox table{.halfExtents = Vec3(2, 2, 1)};
  TumblingBox box{.halfExtents = kHalf, .position = Vec3(0.5, 0.25, 1.125), .gravity = kGravity};
  const FirstContact rests = firstContactOfBoxes(box.moving(), table.moving(), {.from = 0, .until = 10});
  EXPECT_EQ(rests.kind, ContactKind::kTouching);
  EXPECT_EQ(rests.time, 0);
  EXPECT_EQ(rests.normal, Vec3(Vec3::UnitZ()));
  box.position.z() += 1;
  const FirstContact falls = firstContactOfBoxes(box.moving(), table.moving(), {.from = 0, .until = 10});
  EXPECT_EQ(falls.kind, ContactKind::kImpact);
  EXPECT_NEAR(falls.time, 0.5, 1e-16);
  EXPECT_EQ(falls.approach, 4);
}

// A flight run backwards from its first impact leaves the contact and has none until its start.
TEST(Touching, everyImpactRunBackwardsIsLetGo) {
  Dice dice(21);
  int impacts = 0;
  for (int k = 0; k < 2000; ++k) {
    const TumblingBox box = roomFlight(dice, k);
    const Plane wall{.normal = Vec3(0.3, 0.2, 0.9).normalized(), .offset = -2.2};
    const FirstContact hit =
        firstContactWithWall(box.moving(), wall.normal, wall.offset, {.from = 0, .until = 2});
    if (hit.kind == ContactKind::kImpact && heightOverWall<double>(box, wall, 0) > 0) {
      const ReversedBox back{.box = box, .end = hit.time};
      const FirstContact again = firstContactWithWall(back.moving(), wall.normal, wall.offset,
                                                      {.from = 0, .until = 0.999 * hit.time});
      ASSERT_EQ(again.kind, ContactKind::kNone) << k << " at " << again.time << " of " << hit.time;
      ++impacts;
    }
    const Meeting pair = meeting(dice, k);
    const FirstContact meet = firstContactOfBoxes(pair.a.moving(), pair.b.moving(), {.from = 0, .until = 2});
    if (meet.kind == ContactKind::kImpact) {
      const ReversedBox a{.box = pair.a, .end = meet.time};
      const ReversedBox b{.box = pair.b, .end = meet.time};
      const FirstContact again =
          firstContactOfBoxes(a.moving(), b.moving(), {.from = 0, .until = 0.999 * meet.time});
      ASSERT_EQ(again.kind, ContactKind::kNone) << k << " at " << again.time << " of " << meet.time;
      ++impacts;
    }
  }
  EXPECT_GT(impacts, 3000);
}

// Where a function of one variable is least, near the least of 4000 samples.
template <class Gap>
double momentOfLeast(const Gap& gap, double until) {
  constexpr int kSamples = 4000;
  int best = 0;
  for (int i = 0; i <= kSamples; ++i) {
    best = gap(until * i / kSamples) < gap(until * best / kSamples) ? i : best;
  }
  Quad low = until * (best - 1) / kSamples;
  Quad high = until * (best + 1) / kSamples;
  for (int i = 0; i < 64; ++i) {
    const Quad lower = low + (high - low) / 3;
    const Quad upper = high - (high - low) / 3;
    if (gap.exact(lower) < gap.exact(upper)) {
      high = upper;
    } else {
      low = lower;
    }
  }
  return static_cast<double>(low);
}

struct WallGapInTime {
  const TumblingBox& box;
  const Plane& wall;
  double operator()(double t) const { return heightOverWall<double>(box, wall, t); }
  Quad exact(const Quad& t) const { return heightOverWall<Quad>(box, wall, t); }
};

// A wall placed so that a tumbling box comes within ±1e-12 of its size, and no nearer.
TEST(Touching, aGrazeIsTheSideItIsOnDownTo1e12OfTheSize) {
  Dice dice(22);
  int grazes = 0;
  for (int k = 0; k < 60; ++k) {
    TumblingBox box = test::tumblingBox(dice, kHalf, 0.2, 8);
    box.position = Vec3(0, 0, 1);
    Plane wall{.normal = Vec3::UnitZ(), .offset = 0};
    const WallGapInTime gap{.box = box, .wall = wall};
    const double least = momentOfLeast(gap, 1);
    if (least < 0.05 || least > 0.95) {
      continue;
    }
    const double height = static_cast<double>(gap.exact(least));
    const double size = box.halfExtents.norm();
    wall.offset = height + 1e-12 * size;
    EXPECT_EQ(firstContactWithWall(box.moving(), wall.normal, wall.offset, {.from = 0, .until = 1}).kind,
              ContactKind::kImpact);
    wall.offset = height - 1e-12 * size;
    const FirstContact passes =
        firstContactWithWall(box.moving(), wall.normal, wall.offset, {.from = 0, .until = 1});
    EXPECT_EQ(passes.kind, ContactKind::kNone) << passes.time - least;
    EXPECT_LT(passes.evaluations, 2000);
    ++grazes;
  }
  EXPECT_GT(grazes, 15);
}

struct PairGapInTime {
  const TumblingBox& a;
  const TumblingBox& b;
  double operator()(double t) const { return separation<double>(a, b, t); }
  Quad exact(const Quad& t) const { return separation<Quad>(a, b, t); }
};

// The same for two boxes: b is moved along the direction of their nearest approach until, by quadruple
// precision, they come within ±1e-12 of the size.
TEST(Touching, aGrazeOfTwoBoxesIsTheSideItIsOnDownTo1e12OfTheSize) {
  Dice dice(23);
  int grazes = 0;
  int most = 0;
  for (int k = 0; k < 24; ++k) {
    TumblingBox a = test::tumblingBox(dice, kHalf, 0, 6);
    TumblingBox b = test::tumblingBox(dice, kHalf, 0, 6);
    a.position = Vec3(-1.5, 0.8, 0.3);
    a.velocity = Vec3(3, 0, 0);
    const PairGapInTime gap{.a = a, .b = b};
    for (const double side : {1e-12, -1e-12}) {
      double least = 0;
      double off = 0;
      for (int pass = 0; pass < 3; ++pass) {
        least = momentOfLeast(gap, 1);
        Vec3 towardsA = Vec3::Zero();
        separation<double>(a, b, least, &towardsA);
        off = static_cast<double>(gap.exact(least)) - side * kHalf.norm();
        b.position += off * towardsA;
      }
      // Not every approach can be tuned so: the nearest feature may change as b moves.
      const auto depth = static_cast<double>(gap.exact(momentOfLeast(gap, 1)));
      if (least < 0.05 || least > 0.95 || std::fabs(depth - side * kHalf.norm()) > 2e-13) {
        continue;
      }
      const FirstContact hit = firstContactOfBoxes(a.moving(), b.moving(), {.from = 0, .until = 1});
      EXPECT_EQ(hit.kind, side < 0 ? ContactKind::kImpact : ContactKind::kNone) << k;
      most = std::max(most, hit.evaluations);
      ++grazes;
    }
  }
  EXPECT_GT(grazes, 10);
  EXPECT_LT(most, 1000);  // measured 156
}

// A box that leaves every wall it strikes, each time with another spin, for 5000 impacts in a room: contact
// is never reported twice, and no corner is ever outside.
TEST(Touching, fiveThousandBouncesNeverLeaveTheRoom) {
  Dice dice(24);
  TumblingBox box = test::tumblingBox(dice, kHalf, 3, 5);
  box.gravity = kGravity;
  double deepest = 1;
  int evaluations = 0;
  for (int bounce = 0; bounce < 5000; ++bounce) {
    FirstContact first;
    first.time = 100;
    for (int side = 0; side < 6; ++side) {
      const Vec3 normal = (side < 3 ? 1 : -1) * Vec3::Unit(side % 3);
      const FirstContact hit =
          firstContactWithWall(box.moving(), normal, -2, {.from = 0, .until = first.time});
      evaluations += hit.evaluations;
      if (hit.kind != ContactKind::kNone) {
        first = hit;
      }
    }
    ASSERT_EQ(first.kind, ContactKind::kImpact) << bounce;
    ASSERT_GT(first.time, 0) << bounce;
    for (int sample = 0; sample <= 20; ++sample) {
      for (int side = 0; side < 6; ++side) {
        const Plane other{.normal = (side < 3 ? 1 : -1) * Vec3::Unit(side % 3), .offset = -2};
        deepest = std::min(deepest, heightOverWall<double>(box, other, first.time * sample / 20));
      }
    }
    TumblingBox next = test::tumblingBox(dice, kHalf, 3, 5);
    next.start = box.orientation(first.time);
    next.position = box.centre(first.time);
    next.gravity = kGravity;
    // Some leave briskly, some hardly at all.
    const double leaving = std::pow(10, dice.between(-5, 0.5));
    for (int side = 0; side < 6; ++side) {
      const Vec3 normal = (side < 3 ? 1 : -1) * Vec3::Unit(side % 3);
      double missing = 0;
      for (const Vec3& corner : next.corners<double>(0)) {
        if (normal.dot(corner) + 2 < 1e-9) {
          const Vec3 velocity = next.velocity + next(0).angularVelocity.cross(corner - next.position);
          missing = std::max(missing, leaving - normal.dot(velocity));
        }
      }
      next.velocity += missing * normal;
    }
    box = next;
  }
  EXPECT_GE(deepest, -1e-14);           // measured −8.9e-16
  EXPECT_LT(evaluations / 5000.0, 20);  // measured 14.9 for all six walls
}

}  // namespace
}  // namespace careen
