#include "physics/solver/impulse_set.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace careen {
namespace {

using Triple = ContactProblem::Triple;

ImpulseSet cone(double friction) {
  return {.mass = 2,
          .friction = friction,
          .kind = friction == 0 ? ImpulseSet::Kind::kLine : ImpulseSet::Kind::kCone,
          .drag = {}};
}

TEST(ImpulseSet, solutionsAreNoViolation) {
  EXPECT_EQ(cone(0.5).violation({0, 0, 0}, {1, 3, 4}), 0);                 // parts
  EXPECT_EQ(cone(0.5).violation({2, 0.6, -0.8}, {0, 0, 0}), 0);            // sticks, at the limit
  EXPECT_NEAR(cone(0.5).violation({2, -0.6, -0.8}, {0, 3, 4}), 0, 1e-15);  // slides
  EXPECT_EQ(cone(0).violation({2, 0, 0}, {0, 3, 4}), 0);                   // without friction
}

// Each in its own unit: a speed, or an impulse over the mass of 2.
TEST(ImpulseSet, violationsAreMeasured) {
  EXPECT_EQ(cone(0.5).violation({0, 0, 0}, {-1, 0, 0}), 1);       // approaches
  EXPECT_EQ(cone(0.5).violation({4, 0, 0}, {0.25, 0, 0}), 0.25);  // parts though pushed
  EXPECT_EQ(cone(0.5).violation({-4, 0, 0}, {1, 0, 0}), 2);       // pulls
  EXPECT_EQ(cone(0.5).violation({-3, 4, 0}, {0, 0, 0}), 2.5);     // the same: no normal part, no friction
  EXPECT_EQ(cone(0.5).violation({4, 0, 0}, {0, 0, 0.5}), 0.5);    // creeps though it could stick
  EXPECT_NEAR(cone(0.5).violation({2, -1, 0}, {0, 0, 4}), std::sqrt(0.5), 0.1);  // slides elsewhere
  EXPECT_EQ(cone(0.5).violation({2, 2, 0}, {0, 0, 0}), 0.5);                     // friction above its limit
  EXPECT_EQ(cone(1e12).violation({2, 2, 0}, {0, 0.125, 0}), 0.125);
}

TEST(ImpulseSet, admissibleIsInTheCone) {
  EXPECT_EQ(cone(0.5).admissible({-1, 3, 4}), (Triple{}));
  EXPECT_EQ(cone(0.5).admissible({2, 0.5, 0.5}), (Triple{2, 0.5, 0.5}));
  const Triple at = cone(0.5).admissible({2, 3, 4});
  EXPECT_NEAR(at[1], 0.6, 1e-15);
  EXPECT_NEAR(at[2], 0.8, 1e-15);
  ImpulseSet slides = cone(0);
  slides.drag = {-0.5, 0.25};
  EXPECT_EQ(slides.admissible({2, 7, 7}), (Triple{2, -1, 0.5}));
}

// From −1 to 3 N s, of 2 kg.
TEST(ImpulseSet, anIntervalIsAtItsEndsWhereItSlips) {
  const ImpulseSet interval{.mass = 2, .kind = ImpulseSet::Kind::kInterval, .least = -1, .most = 3};
  EXPECT_EQ(interval.violation({2, 0, 0}, {0, 0, 0}), 0);        // sticks
  EXPECT_EQ(interval.violation({-1, 0, 0}, {5, 0, 0}), 0);       // slips up
  EXPECT_EQ(interval.violation({3, 0, 0}, {-5, 0, 0}), 0);       // down
  EXPECT_EQ(interval.violation({2, 0, 0}, {0.25, 0, 0}), 0.25);  // creeps
  EXPECT_EQ(interval.violation({3, 0, 0}, {5, 0, 0}), 2);        // 4 N s off
  EXPECT_EQ(interval.violation({5, 0, 0}, {0, 0, 0}), 1);        // beyond
  EXPECT_EQ(interval.admissible({7, 1, 1}), (Triple{3, 0, 0}));
  EXPECT_EQ(interval.admissible({-7, 1, 1}), (Triple{-1, 0, 0}));
  // Within: 0 = −ρ u − ε (λ − centre). Beyond: λ = 3 − ε (λ − centre), whatever it does to u.
  const ContactEquation equation{.rho = 2, .epsilon = 0.25};
  const ContactAnswer within = newtonAnswer(interval, equation, {1, 0, 0}, {1, 0, 0}, {0.5, 0, 0});
  EXPECT_EQ(within.given[0], -3);
  EXPECT_EQ(within.stiffness[0], 8);
  const ContactAnswer beyond = newtonAnswer(interval, equation, {1, 0, 0}, {-2, 0, 0}, {-5, 0, 0});
  EXPECT_EQ(beyond.given[0], 2);
  EXPECT_EQ(beyond.stiffness[0], 0);
  ImpulseSet one = interval;
  one.least = 3;
  EXPECT_TRUE(one.isGiven());
  EXPECT_EQ(one.violation({3, 0, 0}, {7, 0, 0}), 0);
  EXPECT_EQ(stickingAnswer(one, equation, {}, {7, 0, 0}).given[0], 3);
}

TEST(ImpulseSet, allOfSpaceHoldsWhateverTheImpulse) {
  const ImpulseSet space{.mass = 2, .kind = ImpulseSet::Kind::kSpace};
  for (const Triple& impulse : {Triple{0, 0, 0}, Triple{-3, 4, 1e6}}) {
    EXPECT_EQ(space.violation(impulse, {0, 0, 0}), 0);
    EXPECT_EQ(space.violation(impulse, {-2, 3, 6}), 7);
    EXPECT_EQ(space.admissible(impulse), impulse);
    // 0 = −ρ u − ε (λ − centre), in one step.
    const ContactEquation equation{.rho = 2, .epsilon = 0.25};
    const ContactAnswer answer = newtonAnswer(space, equation, impulse, {1, 2, 3}, {-1, 0.5, 0.25});
    EXPECT_EQ(answer.given, (Triple{9, -2, 1}));
    EXPECT_EQ(answer.stiffness, (std::array<double, 9>{8, 0, 0, 0, 8, 0, 0, 0, 8}));
    EXPECT_EQ(equationError(space, equation, answer.given, {1, 2, 3}, {-1, 0.5, 0.25}), 0);
  }
}

// The answer solves the linearised equation: for a change du that is small, the equation's error at the
// answer is of second order in the size of what is off.
TEST(ImpulseSet, answersSolveTheEquation) {
  const ContactEquation equation{.rho = 2, .epsilon = 0.25};
  const Triple u{-0.1, 0.3, -0.2};
  for (const Triple& impulse : {Triple{1, 0.1, 0.2}, Triple{1, -0.9, 0.3}, Triple{-1, 0, 0}}) {
    for (const double friction : {0.0, 0.5, 3.0}) {
      const ImpulseSet at = cone(friction);
      const Triple centre{0.9, 0.1, 0};
      std::array<double, 2> errors{};
      for (const std::size_t k : {0U, 1U}) {  // Newton's iteration at fixed u
        Triple now = impulse;
        for (std::size_t times = 0; times < 2 + 4 * k; ++times) {
          now = newtonAnswer(at, equation, now, centre, u).given;
        }
        errors[k] = equationError(at, equation, now, centre, u);
      }
      if (impulse[0] > 0) {
        EXPECT_NEAR(errors[1], 0, 1e-14) << friction;
      }
    }
  }
}

// Its stiffness is −dλ/du: a changed u gives the answer that was predicted, to second order.
TEST(ImpulseSet, stiffnessIsTheDerivative) {
  const ContactEquation equation{.rho = 2, .epsilon = 0.25};
  const Triple impulse{1, -0.9, 0.3};
  const Triple centre = impulse;
  const Triple u{-0.1, 0.3, -0.2};
  const auto solved = [&](const Triple& at) {
    Triple now = impulse;
    for (int times = 0; times < 8; ++times) {
      now = newtonAnswer(cone(0.5), equation, now, centre, at).given;
    }
    return now;
  };
  const Triple from = solved(u);
  const ContactAnswer answer = newtonAnswer(cone(0.5), equation, from, centre, u);
  constexpr double kStep = 1e-6;
  for (std::size_t column = 0; column < 3; ++column) {
    Triple moved = u;
    moved[column] += kStep;
    const Triple to = solved(moved);
    for (std::size_t row = 0; row < 3; ++row) {
      EXPECT_NEAR((to[row] - from[row]) / kStep, -answer.stiffness[3 * row + column], 1e-4);
    }
  }
}

}  // namespace
}  // namespace careen
