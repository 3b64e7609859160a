#include "physics/search/translating_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/quad.h"
#include "support/tumbling_box.h"

namespace careen {
namespace {

const Vec3 kUp = Vec3::UnitZ();

/// A box of half size 1 that does not turn, its underside `height` above z = 0.
struct Hopper {
  Attitude attitude{};
  double height = 0;
  double velocity = 0;
  double acceleration = 0;

  Attitude operator()(double /*elapsed*/) const { return attitude; }
  FirstContact meets(double until) const {
    const MovingBox box{.halfExtents = Vec3::Ones(),
                        .position = {0, 0, 1 + height},
                        .velocity = {0, 0, velocity},
                        .acceleration = {0, 0, acceleration},
                        .attitude = AttitudeView(*this)};
    return firstContactTranslating(box, kUp, 0, until);
  }
};

// 2 + t − t² = 0 at t = 2, where it falls by 3 m/s.
TEST(TranslatingContact, byHand) {
  const FirstContact thrown = Hopper{.height = 2, .velocity = 1, .acceleration = -2}.meets(10);
  EXPECT_EQ(thrown.kind, ContactKind::kImpact);
  EXPECT_EQ(thrown.time, 2);
  EXPECT_EQ(thrown.approach, 3);
  EXPECT_EQ(thrown.normal, kUp);
  // 3 − 3t; 2 − 3t + t², the first of 1 and 2; 1 − t²/2 from rest.
  EXPECT_EQ((Hopper{.height = 3, .velocity = -3}.meets(10).time), 1);
  EXPECT_EQ((Hopper{.height = 2, .velocity = -3, .acceleration = 2}.meets(10).time), 1);
  EXPECT_EQ((Hopper{.height = 2, .acceleration = -4}.meets(10).time), 1);
}

TEST(TranslatingContact, isNoneIfItRisesTurnsBackInTimeOrTheWindowEnds) {
  for (const Hopper& box :
       {Hopper{.height = 1}, Hopper{.height = 1, .velocity = 1}, Hopper{.height = 1, .acceleration = 1},
        Hopper{.height = 2, .velocity = -1, .acceleration = 2}, Hopper{.height = 30, .velocity = -2},
        Hopper{.velocity = 1}, Hopper{}}) {
    const FirstContact none = box.meets(10);
    EXPECT_EQ(none.kind, ContactKind::kNone);
    EXPECT_EQ(none.time, 10);
  }
}

TEST(TranslatingContact, endsTheWindowAtTheWindowsEnd) {
  EXPECT_EQ((Hopper{.height = 20, .velocity = -2}.meets(10).kind), ContactKind::kImpact);
  EXPECT_EQ((Hopper{.height = 20, .velocity = -2}.meets(9.75).kind), ContactKind::kNone);
}

// On the wall: falling it strikes at once, sinking from rest it rests, leaving it hops for 2v/|a| exactly.
TEST(TranslatingContact, fromTheWallItself) {
  const FirstContact strikes = Hopper{.velocity = -1, .acceleration = -9}.meets(10);
  EXPECT_EQ(strikes.kind, ContactKind::kImpact);
  EXPECT_EQ(strikes.time, 0);
  EXPECT_EQ(strikes.approach, 1);
  const FirstContact rests = Hopper{.acceleration = -9}.meets(10);
  EXPECT_EQ(rests.kind, ContactKind::kTouching);
  EXPECT_EQ(rests.time, 0);
  for (const double speed : {4.0, 1e-3, 1e-9, 1e-14}) {
    for (const double rounding : {0.0, 1e-15, -1e-15}) {
      const FirstContact hop = Hopper{.height = rounding, .velocity = speed, .acceleration = -8}.meets(10);
      EXPECT_EQ(hop.kind, ContactKind::kImpact);
      EXPECT_EQ(hop.time, speed / 4);
      EXPECT_EQ(hop.approach, speed);
    }
  }
}

// The gap of the lowest corner in quadruple precision is zero at the moment found, and was positive before.
TEST(TranslatingContact, isTheFirstZeroOfTheLowestCornersHeight) {
  test::Dice dice(7);
  int met = 0;
  for (int k = 0; k < 5000; ++k) {
    Hopper turned;
    turned.attitude.worldFromBody = dice.orientation();
    const Vec3 halfExtents(dice.between(0.1, 1), dice.between(0.1, 1), dice.between(0.1, 1));
    const MovingBox box{.halfExtents = halfExtents,
                        .position = dice.vector(3),
                        .velocity = dice.vector(4),
                        .acceleration = dice.vector(5),
                        .attitude = AttitudeView(turned)};
    const Vec3 normal = dice.direction();
    const double offset = dice.between(-6, -1);
    // Σ n·x − h|n·a| − offset.
    Quad lowest = -Quad(offset);
    Quad rate = 0;
    Quad bend = 0;
    for (int i = 0; i < 3; ++i) {
      Quad along = 0;
      for (int j = 0; j < 3; ++j) {
        along += Quad(normal[j]) * Quad(turned.attitude.worldFromBody(j, i));
      }
      lowest += Quad(normal[i]) * box.position[i] - abs(along) * halfExtents[i];
      rate += Quad(normal[i]) * box.velocity[i];
      bend += Quad(normal[i]) * box.acceleration[i];
    }
    if (lowest < 1e-3) {
      continue;  // begins in the wall
    }
    const FirstContact contact = firstContactTranslating(box, normal, offset, 3);
    const auto height = [&](const Quad& t) { return Quad(lowest + t * (rate + t * bend / 2)); };
    for (int i = 1; i < 20; ++i) {
      EXPECT_GT(height(Quad(contact.time) * i / 20), 0);
    }
    if (contact.kind == ContactKind::kImpact) {
      ++met;
      EXPECT_LT(abs(height(Quad(contact.time))), Quad(1e-13));
      EXPECT_LT(abs(rate + bend * contact.time + contact.approach), Quad(1e-13));
      EXPECT_GE(contact.approach, 0);
    } else {
      EXPECT_EQ(contact.time, 3);
      EXPECT_GT(height(Quad(3)), 0);
    }
  }
  EXPECT_GT(met, 1000);
}

}  // namespace
}  // namespace careen
