#include "core/math/elementary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "support/quad.h"
#include "support/without_traps.h"

namespace careen {
namespace {

/// |got − exact| in units in the last place of the correctly rounded result.
double errorInUlps(double got, const Quad& exact) {
  if (exact == 0) {
    return got == 0 ? 0 : std::numeric_limits<double>::infinity();
  }
  int exponent = 0;
  frexp(exact, &exponent);
  return static_cast<double>(abs(ldexp(Quad(got) - exact, 53 - exponent)));
}

class RandomNumbers {
 public:
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11U) * 0x1p-53;
  }
  double logUniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  double sign() { return (generator_() & 1U) == 0 ? 1 : -1; }

 private:
  std::mt19937_64 generator_{1997};
};

double worstSinCos(int count, const auto& draw) {
  RandomNumbers random;
  double worst = 0;
  for (int i = 0; i < count; ++i) {
    const double x = draw(random);
    const elementary::SinCos<double> got = elementary::sinCos(x);
    worst = std::max({worst, errorInUlps(got.sin, sin(Quad(x))), errorInUlps(got.cos, cos(Quad(x)))});
  }
  return worst;
}

TEST(Elementary, sinAndCosAreRightToOneUlpUpToAHundredMillion) {
  // measured 0.77, asserts < 1
  EXPECT_LT(worstSinCos(60000, [](RandomNumbers& r) { return r.sign() * r.logUniform(1e-13, 1e8); }), 1);
}

TEST(Elementary, sinAndCosAreRightToOneUlpNextToTheirZeros) {
  // The doubles nearest to multiples of π/2, where almost all digits cancel. measured 0.50, asserts < 1
  EXPECT_LT(worstSinCos(30000,
                        [](RandomNumbers& r) {
                          const double multiple = std::floor(r.uniform(1, 6e7)) * 0x1.921fb54442d18p+0;
                          return std::nextafter(multiple, r.sign() * 1e300);
                        }),
            1);
}

TEST(Elementary, sinAndCosAreRightToOneUlpUpToTwoToTheFifty) {
  // measured 0.98, asserts < 1
  EXPECT_LT(worstSinCos(30000, [](RandomNumbers& r) { return r.sign() * r.logUniform(1e8, 0x1p50); }), 1);
}

TEST(Elementary, sinAndCosOfAnAngleWithoutDigitsAreNotNumbers) {
  EXPECT_TRUE(std::isnan(elementary::sinCos(0x1p50).sin));
  EXPECT_TRUE(std::isnan(elementary::sinCos(-std::numeric_limits<double>::infinity()).cos));
  EXPECT_TRUE(std::isnan(elementary::sinCos(std::numeric_limits<double>::quiet_NaN()).cos));
}

TEST(Elementary, sinIsOddAndCosIsEvenToTheBit) {
  RandomNumbers random;
  for (int i = 0; i < 100000; ++i) {
    const double x = random.logUniform(1e-3, 1e9);
    EXPECT_EQ(elementary::sinCos(-x).sin, -elementary::sinCos(x).sin) << x;
    EXPECT_EQ(elementary::sinCos(-x).cos, elementary::sinCos(x).cos) << x;
  }
}

TEST(Elementary, quarterTurnsAreSinAndCosOfTheAngleTheyAddUpTo) {
  for (int n = -9; n <= 9; ++n) {
    for (const double rest : {-0.7, -0.1, 0.0, 0.3, 0.78}) {
      const elementary::SinCos<double> got = elementary::sinCosQuarterTurns(n, rest);
      EXPECT_NEAR(got.sin, std::sin(n * 1.5707963267948966 + rest), 5e-15);
      EXPECT_NEAR(got.cos, std::cos(n * 1.5707963267948966 + rest), 5e-15);
      const elementary::SinCos<long double> other =
          elementary::sinCosQuarterTurns<long double>(n, static_cast<long double>(rest));
      EXPECT_NEAR(got.sin, static_cast<double>(other.sin), 2e-16);
      EXPECT_NEAR(got.cos, static_cast<double>(other.cos), 2e-16);
    }
  }
}

TEST(Elementary, expIsRightToOneUlp) {
  RandomNumbers random;
  double worst = 0;
  for (int i = 0; i < 60000; ++i) {
    const double x = i % 2 == 0 ? random.uniform(-708, 709.7) : random.uniform(-1, 1);
    worst = std::max(worst, errorInUlps(elementary::exp(x), exp(Quad(x))));
  }
  EXPECT_LT(worst, 1);  // measured 0.88, asserts < 1
  EXPECT_EQ(elementary::exp(0.0), 1);
  EXPECT_EQ(elementary::exp(-710.0), 0);
  EXPECT_EQ(elementary::exp(710.0), std::numeric_limits<double>::infinity());
}

TEST(Elementary, logIsRightToOneUlp) {
  RandomNumbers random;
  double worst = 0;
  for (int i = 0; i < 60000; ++i) {
    const double x = i % 3 == 0   ? random.logUniform(1e-300, 1e300)
                     : i % 3 == 1 ? random.uniform(0.4, 2.5)
                                  : 1 + random.uniform(-1e-3, 1e-3);
    worst = std::max(worst, errorInUlps(elementary::log(x), log(Quad(x))));
  }
  EXPECT_LT(worst, 1);  // measured 0.79, asserts < 1
  EXPECT_LT(errorInUlps(elementary::log(0x1p-1070), log(Quad(0x1p-1070))), 1);
  EXPECT_EQ(elementary::log(1.0), 0);
  EXPECT_EQ(elementary::log(0.0), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(elementary::log(-1.0)));
}

TEST(Elementary, atan2IsRightToOneUlpInEveryQuadrant) {
  RandomNumbers random;
  double worst = 0;
  for (int i = 0; i < 60000; ++i) {
    const double y = random.sign() * random.logUniform(1e-5, 1e5);
    const double x = random.sign() * random.logUniform(1e-5, 1e5);
    worst = std::max(worst, errorInUlps(elementary::atan2(y, x), atan2(Quad(y), Quad(x))));
  }
  EXPECT_LT(worst, 1);  // measured 0.51, asserts < 1
  EXPECT_EQ(elementary::atan2(0.0, 0.0), 0);
  EXPECT_EQ(elementary::atan2(0.0, 2.0), 0);
  EXPECT_EQ(elementary::atan2(0.0, -2.0), 0x1.921fb54442d18p+1);
  EXPECT_EQ(elementary::atan2(-3.0, 0.0), -0x1.921fb54442d18p+0);
}

// No entry of a table belongs to them.
TEST(Elementary, ofWhatIsNoNumberIsNoNumber) {
  const WithoutTraps quiet;
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(elementary::exp(kNaN)));
  EXPECT_EQ(elementary::exp(kInfinite), kInfinite);
  EXPECT_EQ(elementary::exp(-kInfinite), 0);
  EXPECT_TRUE(std::isnan(elementary::atan2(kNaN, 1)));
  EXPECT_TRUE(std::isnan(elementary::atan2(1, kNaN)));
  EXPECT_TRUE(std::isnan(elementary::atan2(kNaN, kNaN)));
  EXPECT_TRUE(std::isnan(elementary::atan2(kInfinite, kInfinite)));
  EXPECT_TRUE(std::isnan(elementary::sinCosQuarterTurns(kNaN, kNaN).sin));
}

}  // namespace
}  // namespace careen
