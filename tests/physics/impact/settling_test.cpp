#include "physics/impact/settling.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace careen {
namespace {

TEST(Settling, tailIsWhatIsLeftOfTheTimeOfAllBounces) {
  // Dropped from h = 1 m at g = 10: sqrt(2h/g)(1+e)/(1−e) in all, sqrt(2h/g) of it the fall.
  for (const double e : {0.3, 0.5, 0.9, 0.99}) {
    const double fall = std::sqrt(0.2);
    const Bouncing bouncing{.acceleration = -10, .departure = e * 10 * fall, .restitution = e};
    EXPECT_NEAR(fall + settlingTail(bouncing), fall * (1 + e) / (1 - e), 1e-13) << e;  // measured 2e-14
  }
  const Bouncing half{.acceleration = -10, .departure = 5 * std::sqrt(0.2), .restitution = 0.5};
  EXPECT_NEAR(std::sqrt(0.2) + settlingTail(half), 1.3416407864998738, 4e-16);
}

TEST(Settling, hopsAddUpToTheTail) {
  Bouncing bouncing{.acceleration = -9.81, .departure = 2, .restitution = 0.8};
  const double tail = settlingTail(bouncing);
  double sum = 0;
  for (int k = 0; k < 400; ++k) {
    sum += nextHop(bouncing);
    bouncing.departure *= bouncing.restitution;
  }
  EXPECT_NEAR(sum, tail, 1e-14);
}

TEST(Settling, doesNotEndWithoutLossOrWithoutWeight) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  EXPECT_EQ(settlingTail({.acceleration = -10, .departure = 1, .restitution = 1}), kNever);
  EXPECT_EQ(nextHop({.acceleration = 0, .departure = 1, .restitution = 0.5}), kNever);
  EXPECT_EQ(nextHop({.acceleration = 3, .departure = 1, .restitution = 0.5}), kNever);
  EXPECT_FALSE(settles({.acceleration = -10, .departure = 1e-300, .restitution = 1}, 1));
  EXPECT_FALSE(settles({.acceleration = 0, .departure = 0, .restitution = 0.5}, 1));
  EXPECT_TRUE(settles({.acceleration = -10, .departure = 0, .restitution = 0}, 1));
}

TEST(Settling, followsHopsThatCanBeSeenAndNoneThatCannot) {
  // Half extent 0.5 m at g = 10: falls it in 0.32 s; τ = 3e-7 s; the height given up is 1e-13 m.
  EXPECT_FALSE(settles({.acceleration = -10, .departure = 1e-5, .restitution = 0.5}, 0.5));
  const Bouncing last{.acceleration = -10, .departure = 1e-6, .restitution = 0.5};
  EXPECT_TRUE(settles(last, 0.5));
  EXPECT_LT(nextHeight(last), 0.5 * 2.3e-13);
}

TEST(Settling, decidesTheSameAtFourTimesTheLengthAndTwiceTheTime) {
  for (int k = 0; k < 500; ++k) {
    const double v = 1e-8 * (1 + 2 * k);  // τ corresponds to about 1e-6 m/s
    const Bouncing one{.acceleration = -9.81, .departure = v, .restitution = 0.7};
    const Bouncing big{.acceleration = -9.81, .departure = 2 * v, .restitution = 0.7};
    ASSERT_EQ(settles(one, 0.3), settles(big, 1.2));
    ASSERT_EQ(2 * settlingTail(one), settlingTail(big));
    ASSERT_EQ(2 * settlingHop(one, 0.3), settlingHop(big, 1.2));
  }
}

class AfterTail : public ::testing::Test {
 protected:
  std::array<Vec3, 4> arms{Vec3(.3, .2, -.5), Vec3(-.3, .2, -.5), Vec3(.3, -.2, -.5), Vec3(-.3, -.2, -.5)};
  Settling flat{.velocity = Vec3::Zero(),
                .angularVelocity = Vec3::Zero(),
                .normal = Vec3::UnitZ(),
                .gravity = Vec3(0, 0, -9.81),
                .arms = arms,
                .friction = 0,
                .speed = 3};
};

TEST_F(AfterTail, flatOnTheFloorRests) { EXPECT_EQ(afterTail(flat), Settled::kRests); }

TEST_F(AfterTail, whatStillSlidesOrTurnsDoesNotRest) {
  flat.velocity = Vec3(1e-6, 0, 0);
  EXPECT_EQ(afterTail(flat), Settled::kSlides);
  flat.angularVelocity = Vec3(0, 1e-6, 0);
  EXPECT_EQ(afterTail(flat), Settled::kRocks);
}

TEST_F(AfterTail, roundingErrorIsNoMotion) {
  flat.velocity = Vec3(1e-16, 0, 2e-16);
  flat.angularVelocity = Vec3(0, 1e-16, 0);
  EXPECT_EQ(afterTail(flat), Settled::kRests);
}

TEST_F(AfterTail, slopeHoldsWhileItsTangentIsBelowMu) {
  const double slope = 0.3;
  flat.gravity = 9.81 * Vec3(slope, 0, -1) / std::sqrt(1 + slope * slope);
  flat.friction = 0.3000001;
  EXPECT_EQ(afterTail(flat), Settled::kRests);
  flat.friction = 0.2999999;
  EXPECT_EQ(afterTail(flat), Settled::kSlipsDown);
}

TEST_F(AfterTail, tipsWhereTheSlopeIsSteeperThanItsWidth) {
  // Half width 0.3 at half height 0.5: tan θ = 0.6 is the limit, however rough the floor.
  flat.friction = 5;
  for (const double sign : {-1.0, 1.0}) {
    flat.gravity = Vec3(0.5999 * sign, 0, -1);
    EXPECT_EQ(afterTail(flat), Settled::kRests);
    flat.gravity = Vec3(0.6001 * sign, 0, -1);
    EXPECT_EQ(afterTail(flat), Settled::kRocks);
    flat.gravity = Vec3(0, 0.4001 * sign, -1);
    EXPECT_EQ(afterTail(flat), Settled::kRocks);
  }
}

TEST_F(AfterTail, edgeCornerAndCeilingCarryNothing) {
  flat.arms = std::span(arms).first(2);
  EXPECT_EQ(afterTail(flat), Settled::kRocks);
  flat.arms = std::span(arms).first(1);
  EXPECT_EQ(afterTail(flat), Settled::kRocks);
  flat.arms = {};
  EXPECT_EQ(afterTail(flat), Settled::kRocks);
  flat.arms = arms;
  flat.gravity = Vec3(0, 0, 9.81);
  EXPECT_EQ(afterTail(flat), Settled::kRocks);
}

TEST_F(AfterTail, threePointsCarryOnlyWhatIsAboveThem) {
  const std::array<Vec3, 3> around{Vec3(.3, .2, -.5), Vec3(-.3, .2, -.5), Vec3(0, -.2, -.5)};
  flat.arms = around;
  EXPECT_EQ(afterTail(flat), Settled::kRests);
  const std::array<Vec3, 3> beside{Vec3(.3, .2, -.5), Vec3(.1, .2, -.5), Vec3(.2, -.2, -.5)};
  flat.arms = beside;
  EXPECT_EQ(afterTail(flat), Settled::kRocks);
}

}  // namespace
}  // namespace careen
