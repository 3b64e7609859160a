#include "physics/exact/doubt.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/started_bodies.h"

namespace careen {
namespace {

using test::cube;

constexpr double kRadius = 0.8660254037844386;  // [m] of a cube of 1 m, to its corners

TEST(Doubt, growsWithTimeOnlyInFreeMotion) {
  Doubt doubt{.place = 3, .speed = 2, .since = Instant(1)};
  EXPECT_EQ(doubt.at(Instant(1.5)), 4);
  doubt.goOn(Instant(1.5));
  EXPECT_EQ(doubt.place, 4);
  EXPECT_EQ(doubt.speed, 2);
  EXPECT_EQ(doubt.at(Instant(2)), 5);
  doubt.atLeast(1);
  EXPECT_EQ(doubt.place, 4);
  doubt.atLeast(7);
  EXPECT_EQ(doubt.place, 7);
}

// Between walls L apart, at speed v, e = 1: place' = place + speed L/v, then speed' = speed + 2 v place'/R.
// That is the map of a ball between two convex bodies of radius R in line: with k = 2 L/R its determinant is
// 1 and its trace 2 + k, so each impact lets the difference grow by 1 + k/2 + √(k + k²/4).
TEST(Doubt, growsLikeABallBetweenConvexCorners) {
  const Body body = cube("a", {0, 0, 0});
  Body wall;
  wall.mass = immovable();
  constexpr double kSpeed = 3;
  constexpr double kWay = 2;
  const double k = 2 * kWay / kRadius;
  const double factor = 1 + k / 2 + std::sqrt(k + k * k / 4);
  Doubt doubt{.place = 1e-16};
  double before = 0;
  for (int impact = 1; impact <= 12; ++impact) {
    doubt.goOn(Instant(impact * kWay / kSpeed));
    before = impact == 12 ? before : doubt.place;
    std::array<DoubtfulBody, 2> bodies = {
        {{.body = &body, .doubt = &doubt, .speed = kSpeed}, {.body = &wall}}};
    ImpactContact contact;
    contact.a = 0;
    contact.b = 1;
    touch(bodies, contact, {.impulse = 2 * kSpeed * body.mass.mass});
    doubtMore(bodies);
  }
  EXPECT_NEAR(doubt.place / before, factor, 1e-9);
}

/// Two that meet in one contact.
void strikeTogether(std::array<DoubtfulBody, 2>& bodies, double impulse) {
  ImpactContact contact;
  contact.a = 0;
  contact.b = 1;
  touch(bodies, contact, {.impulse = impulse});
  doubtMore(bodies);
}

// 6 N s change the velocity of 1 kg by 6 m/s.
TEST(Doubt, isTheLargerOfTwoInTheirImpact) {
  const Body body = cube("a", {0, 0, 0});
  Doubt known;
  Doubt unknown{.place = 1e-3, .speed = 1e-2};
  std::array<DoubtfulBody, 2> bodies = {
      {{.body = &body, .doubt = &known, .speed = 100}, {.body = &body, .doubt = &unknown, .speed = 100}}};
  strikeTogether(bodies, 6);
  EXPECT_EQ(known.place, 0);
  EXPECT_NEAR(known.speed, 1e-2 + 6 * 1e-3 / kRadius, 1e-17);
  EXPECT_NEAR(unknown.speed, known.speed, 1e-17);
}

TEST(Doubt, isNotFasterThanTheBodyAndNoneOfWhatIsHeld) {
  const Body body = cube("a", {0, 0, 0});
  const Body held = test::held(body);
  Doubt doubt{.place = 1, .speed = 2};
  std::array<DoubtfulBody, 2> bodies = {{{.body = &body, .doubt = &doubt, .speed = 0.5}, {.body = &held}}};
  strikeTogether(bodies, 6);
  EXPECT_EQ(doubt.speed, 0.5);
  EXPECT_EQ(doubt.place, 1);
}

}  // namespace
}  // namespace careen
