#include "physics/motion/listing1.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/math/rotation.h"
#include "support/article_equations.h"
#include "support/free_top.h"
#include "support/physics_worlds.h"

namespace careen {
namespace {

// Listing 1 by hand. I = 2/3 for all axes of a cube of 1 kg with half size 1, so ω = 1.5 L = (0, 0, 3); h ω =
// 0.3. Column 0 becomes (1, 0.3, 0), to be made unit; the velocity that moves r is the old one.
TEST(Listing1, takesEveryRightHandSideAtTheStartOfTheStep) {
  const MassProperties mass = solidBox({1, 1, 1}, 1);
  const BodyState start{.pose = {.position = {1, 2, 3}}, .velocity = {4, 5, 6}, .angularMomentum = {0, 0, 2}};
  const BodyState end = listing1Step(mass, start, {.force = {10, 20, 30}, .torque = {5, 0, 0}}, 0.1);
  EXPECT_LT((end.pose.position - Vec3(1.4, 2.5, 3.6)).norm(), 1e-15);
  EXPECT_LT((end.velocity - Vec3(5, 7, 9)).norm(), 1e-15);
  EXPECT_LT((end.angularMomentum - Vec3(0.5, 0, 2)).norm(), 1e-15);
  Mat3 expected;
  expected << 1, -0.3, 0,  //
      0.3, 1, 0,           //
      0, 0, std::sqrt(1.09);
  EXPECT_LT((end.pose.worldFromBody - expected / std::sqrt(1.09)).norm(), 1e-15);  // measured 1.4e-16
}

TEST(Listing1, startsItsGramSchmidtFromColumn0) {
  const MassProperties mass = solidBox({0.1, 0.2, 0.3}, 1);
  BodyState start;
  start.pose.worldFromBody = axisAngle(Vec3(2, -1, 2) / 3, 1.1);
  start.angularMomentum = angularMomentum(mass, start.pose.worldFromBody, {3, -1, 2});
  const Mat3 loose = start.pose.worldFromBody + 0.1 * orientationRate({3, -1, 2}, start.pose.worldFromBody);
  const Mat3 end = listing1Step(mass, start, {}, 0.1).pose.worldFromBody;
  EXPECT_LT((end.col(0) - loose.col(0).normalized()).norm(), 1e-15)
      << "its direction is kept";  // measured 1.6e-16
  EXPECT_GT((end.col(1) - loose.col(1).normalized()).norm(), 1e-3)
      << "that of the next is not";           // measured 0.043
  EXPECT_LT(orthogonalityError(end), 1e-15);  // measured 2.3e-16
}

TEST(Listing1, leavesTheAngularMomentumOfAFreeBodyAlone) {
  const Body body = makeBox({.halfExtents = {0.1, 0.2, 0.3}, .angularVelocity = {1, 2, 3}});
  BodyState state = body.initial;
  for (int i = 0; i < 1000; ++i) {
    state = listing1Step(body.mass, state, {}, 0.01);
  }
  EXPECT_EQ(state.angularMomentum, body.initial.angularMomentum);
}

/// Where the tumbling box of the reference values is after `duration` in `steps` steps.
BodyState tumbled(const Body& body, double duration, int steps) {
  BodyState state = body.initial;
  const Load weight{.force = body.mass.mass * Vec3(0, 0, -10)};
  for (int i = 0; i < steps; ++i) {
    state = listing1Step(body.mass, state, weight, duration / steps);
  }
  return state;
}

Body tumblingBox() {
  return makeBox({.halfExtents = {0.1, 0.2, 0.3}, .velocity = {1, 2, 3}, .angularVelocity = {1, 2, 3}});
}

// The oracle has to be right before it may judge. Period of the angular momentum seen from the body:
// PHYSICS.md.
TEST(FreeTop, returnsAfterItsPeriodAndKeepsItsEnergy) {
  const Body body = tumblingBox();
  FreeTop top(body.mass.inertiaBody, body.initial.angularMomentum);
  const FreeTop::Real energy = top.energy();
  top.advance(3.67184730265, 40000);
  const double back =
      static_cast<double>((top.momentumBody().cast<double>() - body.initial.angularMomentum).norm() /
                          body.initial.angularMomentum.norm());
  EXPECT_LT(back, 1e-10);                                                      // measured 3.2e-12
  EXPECT_LT(std::abs(static_cast<double>(top.energy() / energy - 1)), 1e-14);  // measured 3.4e-18
}

TEST(Listing1, isOfFirstOrderInFreeFlight) {
  constexpr double kDuration = 1;
  const Body body = tumblingBox();
  FreeTop top(body.mass.inertiaBody, body.initial.angularMomentum);
  top.advance(kDuration, 20000);
  const Vec3 landed = kDuration * Vec3(1, 2, 3) + 0.5 * kDuration * kDuration * Vec3(0, 0, -10);

  std::array<double, 4> turned{};
  std::array<double, 4> moved{};
  std::array<double, 4> energy{};
  for (std::size_t i = 0; i < turned.size(); ++i) {
    const BodyState state = tumbled(body, kDuration, 500 << i);
    turned.at(i) = angleBetween(top.worldFromBody(), state.pose.worldFromBody);
    moved.at(i) = (state.pose.position - landed).norm();
    energy.at(i) = std::abs(angularVelocity(body.mass, state).dot(state.angularMomentum) /
                                (2 * static_cast<double>(top.energy())) -
                            1);
  }
  for (std::size_t i = 0; i + 1 < turned.size(); ++i) {
    // Order: how many halvings of the error one halving of the step gives.
    // Measured 0.998 to 0.9995 (attitude), 1 to 3e-11 (position), 1.001 to 1.004 (energy).
    EXPECT_NEAR(std::log2(turned.at(i) / turned.at(i + 1)), 1, 0.1);
    EXPECT_NEAR(std::log2(moved.at(i) / moved.at(i + 1)), 1, 0.1);
    EXPECT_NEAR(std::log2(energy.at(i) / energy.at(i + 1)), 1, 0.1);
  }
  EXPECT_GT(turned.at(3), 1e-5) << "measured 0.0021: the truncation error, not rounding";
}

// Without the truth: differences between successive halvings shrink by two as well (Richardson).
TEST(Listing1, isOfFirstOrderByRichardson) {
  const Body body = tumblingBox();
  std::array<BodyState, 4> states;
  for (std::size_t i = 0; i < states.size(); ++i) {
    states.at(i) = tumbled(body, 1, 500 << i);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const auto apart = [&](std::size_t k) {
      return (states.at(k).pose.worldFromBody - states.at(k + 1).pose.worldFromBody).norm();
    };
    EXPECT_NEAR(std::log2(apart(i) / apart(i + 1)), 1, 0.1);  // measured 0.997, 0.998
  }
}

}  // namespace
}  // namespace careen
