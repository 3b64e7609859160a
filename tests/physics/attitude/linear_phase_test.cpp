#include "physics/attitude/linear_phase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "support/quad.h"
#include "support/tumbling_box.h"

namespace careen {
namespace {

/// The same angle in quadruple precision.
struct Angle {
  DoubleDouble rate{0};
  double quarterTurns = 0;
  double rest = 0;

  Quad at(double t) const { return quadOf(rate) * Quad(t) + Quad(quarterTurns) * quadPi() / 2 + Quad(rest); }
  LinearPhase<double> phase() const { return {rate, quarterTurns, rest}; }
};

double errorOf(const TurnedAngle<double>& got, const Quad& exact) {
  return static_cast<double>(abs(Quad(got.quarterTurns) * quadPi() / 2 + Quad(got.rest) - exact));
}

Angle randomAngle(test::Dice& dice) {
  const double rate = dice.between(-10, 10);
  return {.rate = normalized(DoubleDouble(rate, rate * dice.between(-1e-17, 1e-17))),
          .quarterTurns = std::floor(dice.between(-4, 4)),
          .rest = dice.between(-0.7, 0.7)};
}

TEST(QuadPi, isTheArcCosineOfMinusOne) { EXPECT_EQ(quadPi(), acos(Quad(-1))); }

// A double for the rate would be off by 10¹⁰ · 2⁻⁵³ = 1e-6 after 10⁹ s at 10 rad/s.
TEST(LinearPhase, knowsAnAngleToARoundingAfterAnyNumberOfTurns) {
  test::Dice dice(1);
  for (const double longest : {1.0, 1e3, 1e6, 1e9}) {
    for (int k = 0; k < 2000; ++k) {
      const Angle angle = randomAngle(dice);
      const double t = dice.between(-longest, longest);
      const Quad exact = angle.at(t);
      const double allowed = 2e-15 + std::ldexp(10 * longest, -78);
      EXPECT_LT(errorOf(angle.phase().at(t), exact), allowed) << t;
      EXPECT_LT(errorOf(angle.phase().preciselyAt(t), exact), allowed) << t;
      EXPECT_LT(std::fabs(angle.phase().at(t).rest), 0.7854);
    }
  }
}

TEST(LinearPhase, isShiftedByQuarterTurns) {
  const LinearPhase<double> phase(DoubleDouble(2), 1, 0.25);
  const TurnedAngle<double> plain = phase.at(0.125);
  const TurnedAngle<double> shifted = phase.at(0.125, -3);
  EXPECT_EQ(shifted.quarterTurns, plain.quarterTurns - 3);
  EXPECT_NEAR(shifted.rest, plain.rest, 1e-15);
  EXPECT_NEAR(plain.rest, 0.5, 1e-15);
}

// rate · t + rest passes zero at t = 1/8 but for what is known of it: −1e-9 there, 9 digits have cancelled.
TEST(LinearPhase, isPreciseWhereItPassesAWholeQuarterTurn) {
  test::Dice dice(2);
  for (int k = 0; k < 2000; ++k) {
    const double t = dice.between(0, 1);
    const double rate = dice.between(0.1, 0.7);
    const double near = dice.between(-1e-9, 1e-9);
    const Angle angle{.rate = DoubleDouble(rate), .quarterTurns = 2, .rest = near - rate * t};
    const Quad exact = angle.at(t) - quadPi();
    const TurnedAngle<double> got = angle.phase().preciselyAt(t);
    EXPECT_EQ(got.quarterTurns, 2);
    EXPECT_LT(static_cast<double>(abs(Quad(got.rest) - exact)), 1e-16) << near;  // measured 6.4e-17
  }
}

TEST(LinearPhase, hasTheSinesOfBothOfTwo) {
  test::Dice dice(3);
  for (int k = 0; k < 2000; ++k) {
    const Angle a = randomAngle(dice);
    const Angle b = randomAngle(dice);
    const double t = dice.between(-1e6, 1e6);
    const auto [sinCosA, sinCosB] = sinCosOfBoth(a.phase(), b.phase(), t);
    EXPECT_LT(static_cast<double>(abs(Quad(sinCosA.sin) - sin(a.at(t)))), 2e-15);  // measured 1.3e-15
    EXPECT_LT(static_cast<double>(abs(Quad(sinCosA.cos) - cos(a.at(t)))), 2e-15);
    EXPECT_LT(static_cast<double>(abs(Quad(sinCosB.sin) - sin(b.at(t)))), 2e-15);
    EXPECT_LT(static_cast<double>(abs(Quad(sinCosB.cos) - cos(b.at(t)))), 2e-15);
  }
}

TEST(LinearPhase, ofAnotherTypeIsTheSameAngle) {
  const LinearPhase<Quad> phase(Quad(3) / 7, Quad(5), Quad(1) / 9);
  const TurnedAngle<Quad> got = phase.at(Quad(1234));
  const Quad exact = Quad(3 * 1234) / 7 + 5 * quadPi() / 2 + Quad(1) / 9;
  EXPECT_LT(static_cast<double>(abs(got.quarterTurns * quadPi() / 2 + got.rest - exact)), 1e-30);
  EXPECT_EQ(got.quarterTurns, floor(got.quarterTurns));
  EXPECT_LT(static_cast<double>(abs(got.rest)), 0.7854);
}

}  // namespace
}  // namespace careen
