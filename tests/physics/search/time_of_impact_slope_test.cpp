// Contacts of boxes in flight under gravity that slopes.

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <cmath>

#include "physics/search/time_of_impact.h"
#include "support/gap_oracle.h"
#include "support/tumbling_box.h"

namespace careen {
namespace {

using test::Dice;
using test::heightOverWall;
using test::meeting;
using test::Meeting;
using test::Plane;
using test::roomFlight;
using test::separation;
using test::TumblingBox;
using Quad = boost::multiprecision::cpp_bin_float_quad;

constexpr double kUntil = 2;

// [s] By which a time is off the root of a falling function, in quadruple precision.
template <class Gap>
double offRoot(const Gap& gap, double time) {
  Quad low = Quad(time) - Quad(1e-7);
  Quad high = Quad(time) + Quad(1e-7);
  EXPECT_GT(gap(low), 0);
  EXPECT_LT(gap(high), 0);
  for (int i = 0; i < 55; ++i) {
    const Quad middle = (low + high) / 2;
    (gap(middle) > 0 ? low : high) = middle;
  }
  return std::fabs(static_cast<double>(low - Quad(time)));
}

struct Tally {
  int impacts = 0;
  int measured = 0;
  double deepest = 1;  // [m] before
  double worst = 0;    // [s]

  void expect(int leastImpacts, int leastMeasured, double most) const {
    EXPECT_GT(impacts, leastImpacts);
    EXPECT_GT(measured, leastMeasured);
    EXPECT_GE(deepest, -1e-14);
    EXPECT_LT(worst, most);
  }
};

// Gravity of up to 8 m/s² that changes by up to 16 in the flight: it turns over in many.
TEST(TimeOfImpactSlope, ofAWallIsTheFirstAndGoodToRounding) {
  Dice dice(21);
  Tally tally;
  for (int k = 0; k < 1000; ++k) {
    TumblingBox box = roomFlight(dice, k);
    box.gravity = dice.vector(8);
    box.jerk = dice.vector(8);
    const Plane wall{.normal = Vec3::Unit(k % 3), .offset = -2.8};
    const FirstContact hit =
        firstContactWithWall(box.moving(), wall.normal, wall.offset, {.from = 0, .until = kUntil});
    for (int sample = 0; sample < 1000; ++sample) {
      tally.deepest = std::min(tally.deepest, heightOverWall<double>(box, wall, hit.time * sample / 1000));
    }
    tally.impacts += hit.kind == ContactKind::kImpact ? 1 : 0;
    if (hit.kind == ContactKind::kImpact && hit.approach > 0.5 && ++tally.measured <= 200) {
      tally.worst = std::max(
          tally.worst, offRoot([&](const Quad& t) { return heightOverWall<Quad>(box, wall, t); }, hit.time));
    }
  }
  tally.expect(300, 200, 2e-15);
}

// Half of them have the same jerk, as two in flight do, the others not, as where one is held.
TEST(TimeOfImpactSlope, ofTwoBoxesIsTheFirstAndGoodToRounding) {
  Dice dice(22);
  Tally tally;
  for (int k = 0; k < 1000; ++k) {
    Meeting pair = meeting(dice, k);
    pair.a.jerk = dice.vector(6);
    if (k % 2 == 0) {
      pair.b.jerk = pair.a.jerk;
    }
    const FirstContact hit =
        firstContactOfBoxes(pair.a.moving(), pair.b.moving(), {.from = 0, .until = kUntil});
    for (int sample = 0; sample < 1000; ++sample) {
      const double t = hit.time * sample / 1000;
      const double radii = pair.a.halfExtents.norm() + pair.b.halfExtents.norm();
      if ((pair.a.centre(t) - pair.b.centre(t)).squaredNorm() < radii * radii) {
        tally.deepest = std::min(tally.deepest, separation<double>(pair.a, pair.b, t));
      }
    }
    tally.impacts += hit.kind == ContactKind::kImpact ? 1 : 0;
    if (hit.kind == ContactKind::kImpact && hit.approach > 0.5 && ++tally.measured <= 60) {
      tally.worst = std::max(
          tally.worst, offRoot([&](const Quad& t) { return separation<Quad>(pair.a, pair.b, t); }, hit.time));
    }
  }
  tally.expect(300, 60, 2e-15);
}

}  // namespace
}  // namespace careen
