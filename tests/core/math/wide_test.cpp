#include "core/math/wide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <type_traits>

#include "support/quad.h"

namespace careen {
namespace {

class WideType : public testing::Test {
 protected:
  double number() {
    const double mantissa = 1 + static_cast<double>(random_() >> 11U) * 0x1p-53;
    const int exponent = static_cast<int>(random_() % 40) - 20;
    return std::ldexp(random_() % 2 == 0 ? mantissa : -mantissa, exponent);
  }
  DoubleDouble wide() {
    const double hi = number();
    return normalized(DoubleDouble(hi, std::ldexp(number(), std::ilogb(hi) - 74)));
  }

 private:
  std::mt19937_64 random_{11};
};

TEST_F(WideType, isTwiceADoubleAndAnyOtherTypeItself) {
  EXPECT_TRUE((std::is_same_v<Wide<double>, DoubleDouble>));
  EXPECT_TRUE((std::is_same_v<Wide<Quad>, Quad>));
  EXPECT_TRUE((std::is_same_v<Wide<float>, float>));
}

// Differences and products of doubles have at most 106 bits here: Quad has 113, so it knows them exactly.
TEST_F(WideType, differencesAndProductsOfDoublesAreExact) {
  for (int k = 0; k < 10000; ++k) {
    const double a = number();
    const double b = number();
    EXPECT_EQ(quadOf(wideDifference<DoubleDouble>(a, b)), Quad(a) - Quad(b));
    EXPECT_EQ(quadOf(wideProduct<DoubleDouble>(a, b)), Quad(a) * Quad(b));
  }
}

TEST_F(WideType, quotientsByASharedInverseKeepTheirDigits) {
  double largest = 0;
  for (int k = 0; k < 10000; ++k) {
    const DoubleDouble a = wide();
    const DoubleDouble b = wide();
    const Quad exact = quadOf(a) / quadOf(b);
    const Quad got = quadOf(quotient(a, b, leadingInverse<double>(b)));
    largest = std::max(largest, std::fabs(static_cast<double>(got / exact - 1)));
  }
  EXPECT_LT(largest, 0x1p-100);
  EXPECT_GT(largest, 0);
}

TEST_F(WideType, takesARestOfTheOrderOfItsRounding) {
  for (int k = 0; k < 1000; ++k) {
    const DoubleDouble a = wide();
    const double rest = std::ldexp(number(), std::ilogb(a.hi) - 74);
    EXPECT_LT(abs(quadOf(withRest(a, rest)) - (quadOf(a) + Quad(rest))), abs(quadOf(a)) * 0x1p-104);
  }
}

// Code written for both is to mean the same.
TEST_F(WideType, functionsOfOtherTypesAreTheTypesOwnOperations) {
  const Quad a = Quad(7) / 3;
  const Quad b = Quad(-5) / 11;
  EXPECT_EQ(normalized(a), a);
  EXPECT_EQ(half(a), a / 2);
  EXPECT_EQ(square(a), a * a);
  EXPECT_EQ(wideDifference<Quad>(a, b), a - b);
  EXPECT_EQ(wideProduct<Quad>(a, b), a * b);
  EXPECT_EQ(withRest(a, b), a + b);
  EXPECT_EQ(leadingInverse<Quad>(b), 1 / b);
  EXPECT_EQ(quotient(a, b, Quad(1 / b)), a * (1 / b));
}

}  // namespace
}  // namespace careen
