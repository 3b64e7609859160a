#include "physics/world/kinematics.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/math/pose.h"
#include "support/article_equations.h"

namespace careen {
namespace {

// Eq. 11 by hand.
TEST(PointPosition, isTheCenterPlusTheTurnedArm) {
  const Pose pose{.position = {10, 20, 30}, .worldFromBody = axisAngle(Vec3::UnitZ(), std::acos(0.0))};
  EXPECT_LT((pose.worldPoint({1, 2, 3}) - Vec3(8, 21, 33)).norm(), 1e-14);  // measured 0
}

// Eq. 12 by hand: two turns' worth about z, arm of 3 along x.
TEST(PointVelocity, addsTurningToMoving) {
  EXPECT_EQ(pointVelocity({1, 1, 1}, {0, 0, 2}, {3, 0, 0}), Vec3(1, 7, 1));
}

// Eq. 13, each term alone: moving, spinning up, and the centripetal ω² r towards the axis, whatever the arm
// has along it.
TEST(PointAcceleration, hasThreeTermsByHand) {
  EXPECT_EQ(pointAcceleration({1, 2, 3}, {0, 0, 0}, {0, 0, 0}, {3, 0, 4}), Vec3(1, 2, 3));
  EXPECT_EQ(pointAcceleration({0, 0, 0}, {0, 0, 5}, {0, 0, 0}, {3, 0, 4}), Vec3(0, 15, 0));
  EXPECT_EQ(pointAcceleration({0, 0, 0}, {0, 0, 0}, {0, 0, 2}, {3, 0, 4}), Vec3(-12, 0, 0));
}

// Eqs. 11–13 on one path known at all times: x = ½at², turning by φ = ½αt² about a fixed axis.
TEST(PointAcceleration, isTheSecondDerivativeOfThePath) {
  const Vec3 axis = Vec3(2, -1, 2) / 3;
  const Vec3 arm(0.4, 0.5, -0.6);
  const Vec3 acceleration(0.3, -9.81, 1);
  constexpr double kAlpha = 0.8;
  const auto position = [&](double t) -> Vec3 {
    return 0.5 * t * t * acceleration + axisAngle(axis, 0.5 * kAlpha * t * t) * arm;
  };
  constexpr double kTime = 1.5;
  constexpr double kStep = 1e-4;
  const Vec3 before = position(kTime - kStep);
  const Vec3 now = position(kTime);
  const Vec3 after = position(kTime + kStep);

  const Vec3 r = axisAngle(axis, 0.5 * kAlpha * kTime * kTime) * arm;
  const Vec3 omega = kAlpha * kTime * axis;
  const Vec3 velocity = pointVelocity(kTime * acceleration, omega, r);
  EXPECT_LT(((after - before) / (2 * kStep) - velocity).norm(), 1e-7);  // measured 4.6e-09
  const Vec3 total = pointAcceleration(acceleration, kAlpha * axis, omega, r);
  EXPECT_LT(((after - 2 * now + before) / (kStep * kStep) - total).norm(), 1e-6);  // measured 2.8e-07
}

// Eq. 14 by hand.
TEST(CenterAcceleration, isForceOverMass) {
  EXPECT_EQ(centerAcceleration(1.0 / 4, {8, -4, 2}), Vec3(2, -1, 0.5));
}

// Eqs. 15 and 16 by hand.
TEST(AngularMomentumAbout, isArmCrossMomentum) {
  EXPECT_EQ(angularMomentumAbout({2, 0, 0}, {0, 3, 0}), Vec3(0, 0, 6));
  EXPECT_EQ(angularMomentumAbout({2, 0, 0}, {5, 0, 0}), Vec3::Zero()) << "straight at A: none";
}

// Eq. 16: the rate of L_AB = r × p is r × F. A mass thrown in a uniform field, by central difference; L is a
// polynomial of degree 3 in t, so the difference errs by h² L'''/6 alone.
TEST(TorqueAbout, isTheRateOfAngularMomentum) {
  constexpr double kMass = 2;
  const Vec3 force(1, -3, 0.5);
  const auto arm = [&](double t) -> Vec3 {
    return Vec3(1, 2, -1) + t * Vec3(0.5, 4, 2) + 0.5 * t * t / kMass * force;
  };
  const auto momentum = [&](double t) -> Vec3 { return kMass * Vec3(0.5, 4, 2) + t * force; };
  constexpr double kStep = 1e-4;
  const Vec3 rate = (angularMomentumAbout(arm(0.7 + kStep), momentum(0.7 + kStep)) -
                     angularMomentumAbout(arm(0.7 - kStep), momentum(0.7 - kStep))) /
                    (2 * kStep);
  EXPECT_LT((rate - torqueAbout(arm(0.7), force)).norm(), 1e-9);  // measured 9.1e-12
}

// Eq. 17 by hand: a dumbbell on x resists turning about y and z only.
TEST(Inertia, ofADumbbellIsWorkedOutByHand) {
  const std::vector<PointMass> dumbbell = {{.mass = 3, .r = {2, 0, 0}}, {.mass = 3, .r = {-2, 0, 0}}};
  EXPECT_EQ(inertia(dumbbell), Mat3(Vec3(0, 24, 24).asDiagonal()));
  EXPECT_EQ(angularMomentum(dumbbell, {5, 1, 0}), Vec3(0, 24, 0));
}

// The products of inertia carry their minus: one mass at (1, 1, 0).
TEST(Inertia, hasNegativeProductsOffTheDiagonal) {
  Mat3 expected;
  expected << 1, -1, 0, -1, 1, 0, 0, 0, 2;
  EXPECT_EQ(inertia(std::vector<PointMass>{{.mass = 1, .r = {1, 1, 0}}}), expected);
}

}  // namespace
}  // namespace careen
