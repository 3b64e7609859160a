#include "physics/attitude/principal_moments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/quad.h"
#include "support/tumbling_box.h"

namespace careen {
namespace {

double relativeError(const DoubleDouble& got, const Quad& exact) {
  return std::fabs(static_cast<double>(quadOf(got) / exact - 1));
}

TEST(PrincipalMoments, areOrderedFromTheSmallestWhicheverAxisHasIt) {
  std::array<double, 3> moments = {1, 2, 3};
  do {
    const PrincipalMoments<double> body(Vec3(moments[0], moments[1], moments[2]));
    for (std::size_t place = 0; place < 3; ++place) {
      EXPECT_EQ(moments.at(body.order.at(place)), static_cast<double>(place + 1));
    }
  } while (std::next_permutation(moments.begin(), moments.end()));
}

TEST(PrincipalMoments, thatAreEqualKeepTheOrderOfTheAxes) {
  EXPECT_EQ(PrincipalMoments<double>(Vec3(2, 2, 2)).order, (std::array<std::size_t, 3>{0, 1, 2}));
  EXPECT_EQ(PrincipalMoments<double>(Vec3(2, 1, 2)).order, (std::array<std::size_t, 3>{1, 0, 2}));
  EXPECT_EQ(PrincipalMoments<double>(Vec3(2, 2, 1)).order, (std::array<std::size_t, 3>{2, 0, 1}));
}

// I = 1, 2, 4: V = 8, n₁₂ = (2 − 1) 4, n₂₃ = (4 − 2) 1, n₁₃ = (4 − 1) 2. The larger n is n₁₂: √(6/4), √(6·2).
TEST(PrincipalMoments, byHand) {
  const PrincipalMoments<double> body(Vec3(4, 1, 2));
  EXPECT_EQ(static_cast<double>(body.n[0]), 4);
  EXPECT_EQ(static_cast<double>(body.n[1]), 2);
  EXPECT_EQ(static_cast<double>(body.n13), 6);
  EXPECT_EQ(body.perN[0], 0.25);
  EXPECT_EQ(body.perN[1], 0.5);
  EXPECT_EQ(body.perN13, 1.0 / 6);
  EXPECT_EQ(static_cast<double>(body.perVolume), 0.125);
  EXPECT_EQ(body.inverseAlongBody, (std::array<double, 3>{0.25, 1, 0.5}));
  EXPECT_TRUE(body.isLarger(0));
  EXPECT_FALSE(body.isLarger(1));
  EXPECT_LT(relativeError(body.precessionRoot[0], sqrt(Quad(6) / 4)), 1e-30);
  EXPECT_LT(relativeError(body.precessionRoot[1], sqrt(Quad(12))), 1e-30);
}

TEST(PrincipalMoments, ofASymmetricBodyHaveNoInfinities) {
  const PrincipalMoments<double> disc(Vec3(1, 1, 2));
  EXPECT_EQ(static_cast<double>(disc.n[0]), 0);
  EXPECT_EQ(disc.perN[0], 0);
  EXPECT_FALSE(disc.isLarger(0));
  EXPECT_TRUE(disc.isLarger(1));
  const PrincipalMoments<double> ball(Vec3(3, 3, 3));
  EXPECT_EQ(ball.perN13, 0);
  EXPECT_FALSE(ball.isLarger(0));
  EXPECT_FALSE(ball.isLarger(1));
}

// n₁₂ = V (1/I₁ − 1/I₂) and the rest by definition, in quadruple precision. Moments that differ in their
// last bits too: there the definition itself loses the digits that the engine's form keeps.
TEST(PrincipalMoments, keepTwiceTheDigits) {
  test::Dice dice(3);
  double largest = 0;
  for (int k = 0; k < 2000; ++k) {
    Vec3 moments(dice.between(0.5, 2), dice.between(0.5, 2), dice.between(0.5, 2));
    if (k % 2 == 0) {
      moments[1] = moments[0] * (1 + std::ldexp(dice.between(1, 2), -(k % 50)));
    }
    const PrincipalMoments<double> body(moments);
    std::array<Quad, 3> sorted = {Quad(moments[0]), Quad(moments[1]), Quad(moments[2])};
    std::sort(sorted.begin(), sorted.end());
    const auto& [i1, i2, i3] = sorted;
    const Quad n12 = (i2 - i1) * i3;
    const Quad n23 = (i3 - i2) * i1;
    const Quad n13 = (i3 - i1) * i2;
    const Quad larger = n12 > n23 ? n12 : n23;
    const Quad smaller = n12 > n23 ? n23 : n12;
    const std::size_t first = n12 > n23 ? 0 : 1;
    for (const double error :
         {relativeError(body.n[0], n12), relativeError(body.n[1], n23), relativeError(body.n13, n13),
          relativeError(body.inverse[0], 1 / i1), relativeError(body.inverse[2], 1 / i3),
          relativeError(body.perVolume, 1 / (i1 * i2 * i3)),
          relativeError(body.precessionRoot.at(first), sqrt(n13 / larger)),
          relativeError(body.precessionRoot.at(1 - first), sqrt(n13 * smaller))}) {
      largest = std::max(largest, error);
    }
  }
  EXPECT_LT(largest, 0x1p-98);
  EXPECT_GT(largest, 0);
}

}  // namespace
}  // namespace careen
