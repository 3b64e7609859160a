#include "physics/world/given_inertia.h"

#include <gtest/gtest.h>

#include <random>

#include "physics/motion/motion.h"
#include "support/input_error.h"

namespace careen {
namespace {

TEST(GivenInertia, ofASolidBoxIsThatOfASolidBox) {
  const MassProperties solid = solidBox({0.1, 0.2, 0.3}, 2);
  EXPECT_EQ(massWithInertia(2, solid.inertiaBody), solid);
}

// Clouds of random points have moments that pass; with the largest raised above the sum of the others they do
// not.
TEST(GivenInertia, whatPointsHaveIsPossibleAndWhatNoneHaveIsNot) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 1000; ++trial) {
    Vec3 squares = Vec3::Zero();
    for (int k = 0; k < 5; ++k) {
      const Vec3 point(normal(random), normal(random),
                       trial % 3 == 0 ? 0 : normal(random));  // flat every third time
      squares += point.cwiseAbs2();
    }
    Vec3 moments = Vec3::Constant(squares.sum()) - squares;
    EXPECT_EQ(whyNoInertia(moments), "");
    Eigen::Index largest = 0;
    moments.maxCoeff(&largest);
    moments[largest] = (moments.sum() - moments[largest]) * (1 + 1e-9);
    EXPECT_NE(whyNoInertia(moments), "");
  }
}

TEST(GivenInertia, whatIsNotPositiveIsRefused) {
  EXPECT_NE(whyNoInertia({1, 1, 0}), "");
  EXPECT_NE(whyNoInertia({1, -1, 1}), "");
  EXPECT_EQ(whyNoInertia({1, 2, 4}), "no moment of inertia above the sum of the two others, 3 kg m²");
  EXPECT_NE(inputErrorOf([] { massWithInertia(0, Vec3::Ones()); }), "no error");
  EXPECT_NE(inputErrorOf([] { massWithInertia(1, {1, 2, 4}); }), "no error");
}

// A symmetric top of moments 1, 1, 2 kg m², spun at (1, 0, 3) rad/s: its axis circles L at |L|/I₁ = √37
// rad/s.
TEST(GivenInertia, aTopPrecessesByIt) {
  const MassProperties top = massWithInertia(5, {1, 1, 2});
  Flight flight;
  flight.angularMomentum = Vec3(1, 0, 6);
  const double period = 2 * 3.14159265358979323846 / std::sqrt(37.0);
  const Vec3 axis = stateAt(flight, top, 0).pose.worldFromBody.col(2);
  EXPECT_LT((stateAt(flight, top, period).pose.worldFromBody.col(2) - axis).norm(), 1e-14);
  // Half a turn about L: the axis mirrored at it.
  const Vec3 l = flight.angularMomentum.normalized();
  const Vec3 opposite = 2 * l.dot(axis) * l - axis;
  EXPECT_LT((stateAt(flight, top, period / 2).pose.worldFromBody.col(2) - opposite).norm(), 1e-14);
}

}  // namespace
}  // namespace careen
