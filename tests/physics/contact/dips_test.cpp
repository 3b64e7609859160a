#include "physics/contact/dips.h"

#include <gtest/gtest.h>

#include <cmath>

namespace careen {
namespace {

// f = (t − 1)² + lowest in a step of 4 s.
double lowestOfSquare(double lowest) { return lowestOfCubic(4, 1 + lowest, -2, 9 + lowest, 6); }

TEST(Dips, lowestOfAQuadraticIsItsVertex) {
  EXPECT_NEAR(lowestOfSquare(-0.25), 1, 1e-15);
  EXPECT_EQ(lowestOfSquare(0.25), 0);
  EXPECT_EQ(lowestOfSquare(0), 0);
}

// f = t³ − 3 t + 1.5 from 0 to 2: lowest at 1, where it is −0.5.
TEST(Dips, lowestOfACubicIsBetweenItsTurns) {
  EXPECT_NEAR(lowestOfCubic(2, 1.5, -3, 3.5, 9), 1, 1e-15);
  EXPECT_EQ(lowestOfCubic(2, 2.5, -3, 4.5, 9), 0);
  EXPECT_EQ(lowestOfCubic(1, 1, 2, 3, 2), 0);    // a line
  EXPECT_EQ(lowestOfCubic(1, 3, -2, 1, -2), 0);  // falling to its end
}

TEST(Dips, lowestBetweenTwoTimesIsFoundWhateverTheShape) {
  EXPECT_NEAR(lowestBetween(1, 4, [](double t) { return std::fabs(t - 2.2); }), 2.2, 3.0 / 300);
  EXPECT_NEAR(lowestBetween(0, 1, [](double t) { return t; }), 0, 1.0 / 300);
}

// Deeper than 1e-3 from 0.30 to 0.70: samples are at k/16, the first of them at 5/16.
TEST(Dips, aWideDipIsSeenAtItsFirstSample) {
  const auto gap = [](double t) { return (t - 0.5) * (t - 0.5) - 0.04 - 1e-3; };
  EXPECT_EQ(deepMoment(gap, 1, 1e-3), 0.3125);
}

// Below −1e-3 from 0.385 to 0.415: between the samples at 0.375 and 0.4375.
TEST(Dips, aNarrowDipIsSearchedForBetweenSamples) {
  const auto gap = [](double t) { return 0.02 * std::fabs(t - 0.4) - 1.3e-3; };
  EXPECT_NEAR(deepMoment(gap, 1, 1e-3), 0.4, 3e-4);
  EXPECT_EQ(deepMoment([&](double t) { return gap(t) + 0.5e-3; }, 1, 1e-3), 0);
}

// No step, however short, would be without what there was at its start.
TEST(Dips, depthAtTheStartIsNoDip) {
  EXPECT_EQ(deepMoment([](double) { return -1e-2; }, 1, 1e-3), 0);
  // A 16th of the tolerance deeper after 0.104.
  EXPECT_EQ(deepMoment([](double t) { return -1e-2 - 0.6e-3 * t; }, 1, 1e-3), 0.125);
  EXPECT_EQ(deepMoment([](double) { return 1.0; }, 1, 1e-3), 0);
}

}  // namespace
}  // namespace careen
