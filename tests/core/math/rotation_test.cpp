#include "core/math/rotation.h"

#include <numbers>

#include <gtest/gtest.h>

#include "support/article_equations.h"

namespace careen {
namespace {

constexpr double kRight = std::numbers::pi / 2;

const Vec3 kAxis = Vec3(2, -1, 2) / 3;  // unit
const Vec3 kR(0.7, -1.3, 2.1);

// Eq. 9, entry by entry and as the cross product it represents.
TEST(Tilde, turnsACrossProductIntoAMatrixProduct) {
  Mat3 expected;
  expected << 0, -3, 2,  //
      3, 0, -1,          //
      -2, 1, 0;
  EXPECT_EQ(tilde({1, 2, 3}), expected);
  EXPECT_EQ(Vec3(tilde({1, 2, 3}) * kR), Vec3(1, 2, 3).cross(kR));
}

TEST(Tilde, isSkewSymmetric) { EXPECT_EQ(Mat3(tilde(kR).transpose()), Mat3(-tilde(kR))); }

// Eq. 2 by hand: A maps x to y, so what B does to x the result does to y.
TEST(SimilarityTransform, carriesAMatrixIntoAnotherSpace) {
  const Mat3 a = axisAngle(Vec3::UnitZ(), kRight);
  const Mat3 b = Vec3(1, 2, 3).asDiagonal();
  const Mat3 expected = Vec3(2, 1, 3).asDiagonal();
  EXPECT_LT((similarityTransform(a, b) - expected).norm(), 1e-15);  // measured 8.7e-17
}

// The meaning of Eq. 2: map, act, map back.
TEST(SimilarityTransform, actsAsTheOriginalDoesInItsOwnSpace) {
  const Mat3 a = axisAngle(kAxis, 1.1);
  Mat3 b;
  b << 1, 2, 3, 4, 5, 6, 7, 8, 10;
  const Vec3 viaBody = a * (b * (a.transpose() * kR));
  EXPECT_LT((similarityTransform(a, b) * kR - viaBody).norm(), 2e-14);  // measured 2.5e-15
}

// Eqs. 3–5 by hand about z.
TEST(DecomposeAboutAxis, takesAVectorApartByHand) {
  const AxisDecomposition parts = decomposeAboutAxis(Vec3::UnitZ(), {3, 4, 5});
  EXPECT_EQ(parts.along, Vec3(0, 0, 5));
  EXPECT_EQ(parts.radial, Vec3(3, 4, 0));
  EXPECT_EQ(parts.ahead, Vec3(-4, 3, 0));
}

TEST(DecomposeAboutAxis, givesAFrameInWhichTheVectorTurns) {
  const AxisDecomposition parts = decomposeAboutAxis(kAxis, kR);
  EXPECT_LT((parts.along + parts.radial - kR).norm(), 1e-15);   // measured 0
  EXPECT_LT(std::abs(parts.radial.dot(kAxis)), 1e-15);          // measured 2.2e-16
  EXPECT_LT(std::abs(parts.ahead.dot(parts.radial)), 1e-15);    // measured 1.7e-16
  EXPECT_NEAR(parts.ahead.norm(), parts.radial.norm(), 1e-15);  // measured 0
  EXPECT_GT(kAxis.cross(parts.radial).dot(parts.ahead), 0) << "right-handed";
}

// Eq. 6 by hand: a third of a turn about the diagonal permutes the axes.
TEST(RotateAboutAxis, permutesTheAxesByAThirdOfATurn) {
  const Vec3 diagonal = Vec3::Ones() / std::sqrt(3.0);
  const Vec3 turned = rotateAboutAxis(diagonal, 2 * std::numbers::pi / 3, {1, 2, 3});
  EXPECT_LT((turned - Vec3(3, 1, 2)).norm(), 4e-15);  // measured 1.3e-15
}

TEST(RotateAboutAxis, turnsCounterclockwiseSeenAgainstTheAxis) {
  EXPECT_LT((rotateAboutAxis(Vec3::UnitZ(), kRight, Vec3::UnitX()) - Vec3::UnitY()).norm(), 1e-16);
}

TEST(RotateAboutAxis, keepsLengthAndUndoesItself) {
  const Vec3 turned = rotateAboutAxis(kAxis, 2.3, kR);
  EXPECT_NEAR(turned.norm(), kR.norm(), 2e-15);                          // measured 4.4e-16
  EXPECT_LT((rotateAboutAxis(kAxis, -2.3, turned) - kR).norm(), 2e-15);  // measured 2.2e-16
}

TEST(AxisAngle, isTheMatrixOfRotateAboutAxis) {
  for (const double angle : {-3.0, 0.0, 1e-9, 0.4, kRight, 3.1}) {
    const Mat3 a = axisAngle(kAxis, angle);
    EXPECT_LT((a * kR - rotateAboutAxis(kAxis, angle, kR)).norm(), 2e-15) << angle;  // measured 4.7e-16
  }
}

// Eq. 1.
TEST(AxisAngle, isSpecialOrthogonal) {
  const Mat3 a = axisAngle(kAxis, 2.3);
  EXPECT_LT(orthogonalityError(a), 1e-15);  // measured 2.5e-16
  EXPECT_NEAR(a.determinant(), 1, 1e-15);   // measured 2.2e-16
}

// Eqs. 7, 8: a vector that rotates with θ̇ about n has the rate θ̇ n × r. Central difference of Eq. 6.
TEST(OrientationRate, isTheRateOfATurningVector) {
  constexpr double kRate = 1.7;
  constexpr double kStep = 1e-5;
  const Vec3 difference =
      rotateAboutAxis(kAxis, kRate * kStep, kR) - rotateAboutAxis(kAxis, -kRate * kStep, kR);
  const Vec3 numerical = difference / (2 * kStep);
  EXPECT_LT((numerical - kRate * kAxis.cross(kR)).norm(), 1e-9);  // measured 9.3e-11, h² θ̇³ |r| / 6
  EXPECT_EQ(Vec3(tilde(kRate * kAxis) * kR), Vec3((kRate * kAxis).cross(kR)));
}

// Eq. 10, column by column: each column is a rotating vector.
TEST(OrientationRate, turnsEveryColumn) {
  const Vec3 omega(1, -2, 0.5);
  const Mat3 a = axisAngle(kAxis, 0.9);
  const Mat3 rate = orientationRate(omega, a);
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT((rate.col(i) - omega.cross(a.col(i))).norm(), 1e-15);  // measured 0
  }
}

TEST(OrthonormalizeFromColumn0, keepsColumn0sDirectionAndTheFirstTwosPlane) {
  Mat3 bent;
  bent << 2, 1, 9, 0, 3, 9, 0, 0, 9;
  EXPECT_EQ(orthonormalizeFromColumn0(bent), Mat3::Identity()) << "by hand; column 2 is ignored";
}

TEST(OrthonormalizeFromColumn0, makesAStepOfEulerARotationAgain) {
  const Mat3 a = axisAngle(kAxis, 0.9);
  const Mat3 stepped = a + 0.1 * orientationRate({1, -2, 0.5}, a);
  EXPECT_GT(orthogonalityError(stepped), 0.03) << "measured 0.074: the step leaves an error to remove";
  const Mat3 result = orthonormalizeFromColumn0(stepped);
  EXPECT_LT(orthogonalityError(result), 2e-15);  // measured 3e-16
  EXPECT_NEAR(result.determinant(), 1, 2e-15);
}

// By hand: AAᵀ − 1 of 2·1 is 3·1.
TEST(OrthogonalityError, isTheFrobeniusNorm) {
  EXPECT_EQ(orthogonalityError(Mat3::Identity()), 0);
  EXPECT_NEAR(orthogonalityError(2 * Mat3::Identity()), 3 * std::sqrt(3.0), 1e-15);
}

}  // namespace
}  // namespace careen
