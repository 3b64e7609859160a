#include "physics/attitude/polhode.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/quad.h"
#include "support/tumbling_box.h"

namespace careen {
namespace {

using Kind = Polhode<double>::Kind;

std::array<DoubleDouble, 3> wide(const Vec3& m) { return {m.x(), m.y(), m.z()}; }

double relativeError(const Quad& got, const Quad& exact) {
  return std::fabs(static_cast<double>(got / exact - 1));
}

Vec3 momentsOf(test::Dice& dice) {
  const Vec3 squares(dice.between(0.1, 1), dice.between(0.1, 1), dice.between(0.1, 1));
  return {squares.y() + squares.z(), squares.z() + squares.x(), squares.x() + squares.y()};
}

// I = 1, 2, 3 along x, y, z, n₁₂ = 3, n₂₃ = 1: the excess mx² n₁₂ − mz² n₂₃ decides.
TEST(Polhode, circlesTheAxisOfTheSmallestOrTheLargestMoment) {
  const PrincipalMoments<double> body(Vec3(1, 2, 3));
  const Polhode<double> aroundX(body, wide({1, 1, 1}));  // 3 − 1
  EXPECT_EQ(aroundX.kind, Kind::kGeneral);
  EXPECT_EQ(aroundX.circled, 0U);
  EXPECT_EQ(aroundX.frame.bodyAxis[2], 0);
  EXPECT_EQ(static_cast<double>(aroundX.d), 2);
  const Polhode<double> aroundZ(body, wide({1, 1, 2}));  // 3 − 4
  EXPECT_EQ(aroundZ.kind, Kind::kGeneral);
  EXPECT_EQ(aroundZ.circled, 1U);
  EXPECT_EQ(aroundZ.frame.bodyAxis[2], 2);
  EXPECT_EQ(static_cast<double>(aroundZ.d), 1);
  EXPECT_EQ(static_cast<double>(aroundZ.excess()), -1);
}

TEST(Polhode, knowsItsSpecialCases) {
  const PrincipalMoments<double> body(Vec3(1, 2, 5));  // n₁₂ = 5, n₂₃ = 3
  EXPECT_EQ(Polhode<double>(body, wide({0, 2, 0})).kind, Kind::kFixedAxis);
  EXPECT_EQ(Polhode<double>(body, wide({0, 0, -1})).kind, Kind::kFixedAxis);
  EXPECT_EQ(Polhode<double>(body, wide(Vec3::Zero())).kind, Kind::kFixedAxis);
  EXPECT_EQ(Polhode<double>(body, wide({1, 2, 0})).kind, Kind::kGeneral);
  const PrincipalMoments<double> even(Vec3(2, 3, 6));  // n₁₂ = 6, n₂₃ = 6
  EXPECT_EQ(Polhode<double>(even, wide({1, 0.5, -1})).kind, Kind::kSeparatrix);
  EXPECT_EQ(Polhode<double>(even, wide({1, 0.5, std::nextafter(1, 2)})).kind, Kind::kGeneral);
  const PrincipalMoments<double> disc(Vec3(2, 5, 2));
  const Polhode<double> symmetric(disc, wide({1, 2, 3}));
  EXPECT_EQ(symmetric.kind, Kind::kSymmetric);
  EXPECT_EQ(symmetric.frame.bodyAxis[2], 1);
  const PrincipalMoments<double> ball(Vec3(2, 2, 2));
  EXPECT_EQ(Polhode<double>(ball, wide({1, 2, 3})).kind, Kind::kSymmetric);
}

// The definitions of torque_free_rotation.h: A² = ma² + mb² BC/AC, C² = mc² + mb² AB/AC, G² = A² + C²,
// D = ma² AB − mc² BC, with the denominators cleared by V.
TEST(Polhode, hasTheQuantitiesOfItsDefinitions) {
  test::Dice dice(1);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 moments = momentsOf(dice);
    const PrincipalMoments<double> body(moments);
    const Vec3 momentum = dice.vector(2);
    const Polhode<double> polhode(body, wide(momentum));
    ASSERT_EQ(polhode.kind, Kind::kGeneral);
    const int b = polhode.frame.bodyAxis[0];
    const int c = polhode.frame.bodyAxis[1];
    const int a = polhode.frame.bodyAxis[2];
    const Quad volume = Quad(moments[0]) * moments[1] * moments[2];
    const auto between = [&](int i, int j) {  // V |1/Ii − 1/Ij|
      return Quad(abs(Quad(1) / moments[i] - Quad(1) / moments[j]) * volume);
    };
    const Quad ma = momentum[a];
    const Quad mb = momentum[b];
    const Quad mc = momentum[c];
    const Quad aSquared = ma * ma + mb * mb * between(b, c) / between(a, c);
    const Quad cSquared = mc * mc + mb * mb * between(a, b) / between(a, c);
    const Quad d = ma * ma * between(a, b) - mc * mc * between(b, c);
    EXPECT_GT(d, 0);
    // What cancels in D is a part of its terms.
    EXPECT_LT(abs(quadOf(polhode.d) - d), 1e-29 * (ma * ma * between(a, b)));
    EXPECT_LT(relativeError(quadOf(polhode.p), aSquared * between(a, c)), 1e-28);
    EXPECT_LT(relativeError(polhode.s, cSquared * between(a, c)), 4e-15);
    EXPECT_LT(relativeError(polhode.aSquared, aSquared), 2e-15);
    EXPECT_LT(relativeError(polhode.cSquared, cSquared), 4e-15);
    EXPECT_LT(relativeError(quadOf(polhode.momentumSquared), ma * ma + mb * mb + mc * mc), 1e-30);
    EXPECT_LT(relativeError(quadOf(polhode.momentum), sqrt(aSquared + cSquared)), 1e-30);
    EXPECT_LT(relativeError(quadOf(polhode.perIa()), Quad(1) / moments[a]), 1e-30);
    EXPECT_LT(relativeError(quadOf(polhode.perIc()), Quad(1) / moments[c]), 1e-30);
    EXPECT_EQ(polhode.magnification, 1);
  }
}

// x = ±b, y = ±c, z = ±a: a right-handed frame in which the momentum is (mb, mc, ma) with ma > 0.
TEST(Polhode, frameIsRightHandedAndTheMomentumPositiveAlongZ) {
  test::Dice dice(2);
  for (int k = 0; k < 2000; ++k) {
    const PrincipalMoments<double> body(momentsOf(dice));
    const Vec3 momentum = dice.vector(2);
    const Polhode<double> polhode(body, wide(momentum));
    Mat3 frameFromBody;
    for (int axis = 0; axis < 3; ++axis) {
      frameFromBody.col(axis) = polhode.frame.fromBody(Vec3::Unit(axis));
    }
    EXPECT_EQ(frameFromBody.determinant(), 1);
    EXPECT_EQ(frameFromBody * momentum, Vec3(polhode.mb, polhode.mc, polhode.ma));
    EXPECT_GT(polhode.ma, 0);
    EXPECT_EQ(static_cast<double>(polhode.alongZ), polhode.ma);
  }
}

// A half turn of the body about one of its axes is two signs of the momentum.
TEST(Polhode, isTheSameBitsForABodyTurnedHalfAbout) {
  test::Dice dice(3);
  for (int k = 0; k < 500; ++k) {
    const PrincipalMoments<double> body(momentsOf(dice));
    const Vec3 momentum = dice.vector(2);
    const Polhode<double> plain(body, wide(momentum));
    for (const Vec3& signs : {Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)}) {
      const Polhode<double> turned(body, wide(momentum.cwiseProduct(signs)));
      EXPECT_EQ(turned.circled, plain.circled);
      EXPECT_EQ(Vec3(turned.mb, turned.mc, turned.ma), Vec3(plain.mb, plain.mc, plain.ma));
      EXPECT_EQ(turned.d.hi, plain.d.hi);
      EXPECT_EQ(turned.d.lo, plain.d.lo);
    }
  }
}

// Off the middle axis by 1e-200 the squares would be 0: d is then that of a larger momentum.
TEST(Polhode, keepsTheDistanceFromTheMiddleAxisHoweverSmall) {
  const PrincipalMoments<double> body(Vec3(1, 2, 3));
  const Polhode<double> polhode(body, wide({1e-200, 1, 1e-250}));
  EXPECT_EQ(polhode.kind, Kind::kGeneral);
  EXPECT_EQ(polhode.circled, 0U);
  EXPECT_GT(polhode.magnification, 1);
  const double enlarged = 1e-200 * polhode.magnification;
  EXPECT_NEAR(static_cast<double>(polhode.d) / (3 * enlarged * enlarged), 1, 1e-15);
  EXPECT_EQ(static_cast<double>(polhode.alongZ), 1e-200);
}

}  // namespace
}  // namespace careen
