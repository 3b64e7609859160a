#include "physics/attitude/cayley_klein.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "support/quad.h"
#include "support/tumbling_box.h"

namespace careen {
namespace {

Quat randomTurn(test::Dice& dice) {
  const Vec3 axis = dice.vector(1);
  return {dice.between(-1, 1), axis.x(), axis.y(), axis.z()};
}

CayleyKlein<double> parametersOf(const Quat& q) { return {q.w(), q.z(), q.x(), q.y()}; }

TEST(CayleyKlein, productIsThatOfQuaternions) {
  test::Dice dice(1);
  for (int k = 0; k < 1000; ++k) {
    const Quat p = randomTurn(dice);
    const Quat q = randomTurn(dice);
    const Quat turn = p * q;
    const CayleyKlein<double> got = product(parametersOf(p), parametersOf(q));
    EXPECT_NEAR(got.alphaRe, turn.w(), 1e-15);
    EXPECT_NEAR(got.alphaIm, turn.z(), 1e-15);
    EXPECT_NEAR(got.betaRe, turn.x(), 1e-15);
    EXPECT_NEAR(got.betaIm, turn.y(), 1e-15);
    EXPECT_NEAR(squaredNorm(got), p.squaredNorm() * q.squaredNorm(), 4e-15);
  }
}

TEST(CayleyKlein, aTurnAboutZMultipliesBothByAPhase) {
  const double half = 0.3;
  const CayleyKlein<double> turn = {std::cos(half), std::sin(half), 0, 0};
  // (α, β) = (1 + 2i, 3 − i), in complex numbers: times cos + i sin each.
  const CayleyKlein<double> got = product(turn, {1, 2, 3, -1});
  EXPECT_NEAR(got.alphaRe, std::cos(half) - 2 * std::sin(half), 1e-15);
  EXPECT_NEAR(got.alphaIm, 2 * std::cos(half) + std::sin(half), 1e-15);
  EXPECT_NEAR(got.betaRe, 3 * std::cos(half) + std::sin(half), 1e-15);
  EXPECT_NEAR(got.betaIm, 3 * std::sin(half) - std::cos(half), 1e-15);
}

// R⁻¹v by the rotation matrix's formula with its divisor, in quadruple precision.
std::array<Quad, 3> turnedBackInQuad(const Quat& q, const Vec3& v) {
  const Quad w(q.w());
  const std::array<Quad, 3> u = {-Quad(q.x()), -Quad(q.y()), -Quad(q.z())};
  const Quad scale = 2 / (w * w + u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
  const auto cross = [&u](const std::array<Quad, 3>& x) {
    return std::array<Quad, 3>{u[1] * x[2] - u[2] * x[1], u[2] * x[0] - u[0] * x[2],
                               u[0] * x[1] - u[1] * x[0]};
  };
  const std::array<Quad, 3> from = {Quad(v.x()), Quad(v.y()), Quad(v.z())};
  const std::array<Quad, 3> once = cross(from);
  const std::array<Quad, 3> twice = cross(once);
  return {from[0] + scale * (w * once[0] + twice[0]), from[1] + scale * (w * once[1] + twice[1]),
          from[2] + scale * (w * once[2] + twice[2])};
}

double largestError(const Quat& q, const Vec3& v) {
  const std::array<DoubleDouble, 3> got = turnedBack<DoubleDouble>(q, v);
  const std::array<Quad, 3> exact = turnedBackInQuad(q, v);
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Quad off = Quad(got[i].hi) + Quad(got[i].lo) - exact[i];
    largest = std::max(largest, std::fabs(static_cast<double>(off)) / v.norm());
  }
  return largest;
}

TEST(CayleyKlein, turnsBackInTwiceTheDigitsByQuaternionsOfAnyLength) {
  test::Dice dice(2);
  double unit = 0;
  double other = 0;
  for (int k = 0; k < 2000; ++k) {
    const Quat q = randomTurn(dice);
    const Vec3 v = dice.vector(3);
    unit = std::max(unit, largestError(q.normalized(), v));
    other = std::max(other, largestError(q, v));
  }
  RecordProperty("unit", std::to_string(unit));
  EXPECT_LT(unit, 1e-30);
  EXPECT_LT(other, 1e-29);
}

// About z by 90°: x comes from −y, y from x.
TEST(CayleyKlein, turnsBackByHand) {
  const Quat quarter(1, 0, 0, 1);
  const std::array<double, 3> got = turnedBack<double>(quarter, Vec3(2, 3, 5));
  EXPECT_EQ(got, (std::array<double, 3>{3, -2, 5}));
}

}  // namespace
}  // namespace careen
