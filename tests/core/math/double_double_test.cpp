#include "core/math/double_double.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "support/quad.h"

namespace careen {
namespace {

/// Quadruple precision (113 bits) cannot hold every pair (2 × 53 bits and a gap) but gets within 2⁻¹¹³ of it.
Quad exact(const DoubleDouble& x) { return Quad(x.hi) + Quad(x.lo); }

class RandomDoubles {
 public:
  DoubleDouble positive() {
    const double hi = std::ldexp(fraction() + 0.5, static_cast<int>(generator_() % 40) - 20);
    return normalized({hi, hi * (fraction() - 0.5) * 0x1p-53});
  }
  DoubleDouble any() { return (generator_() & 1U) == 0 ? positive() : -positive(); }

 private:
  double fraction() { return static_cast<double>(generator_() >> 11U) * 0x1p-53; }
  std::mt19937_64 generator_{1971};
};

/// The largest error in units of 2⁻¹⁰⁰ relative to `scale`.
struct Worst {
  double value = 0;
  void add(const Quad& got, const Quad& want, const Quad& scale) {
    value = std::max(value, static_cast<double>(ldexp(Quad(abs(Quad(got - want)) / scale), 100)));
  }
};

constexpr int kCases = 50000;

TEST(DoubleDouble, sumsAndProductsOfTwoDoublesAreExact) {
  RandomDoubles random;
  for (int i = 0; i < kCases; ++i) {
    const double a = random.any().hi;
    const double b = random.any().hi;
    EXPECT_EQ(exact(twoSum(a, b)), Quad(a) + Quad(b));
    EXPECT_EQ(exact(twoProduct(a, b)), Quad(a) * Quad(b));
    EXPECT_EQ(exact(twoSquare(a)), Quad(a) * Quad(a));
    EXPECT_EQ(split(a).hi + split(a).lo, a);
    const double larger = std::fabs(a) < std::fabs(b) ? b : a;
    const double smaller = std::fabs(a) < std::fabs(b) ? a : b;
    EXPECT_EQ(exact(fastTwoSum(larger, smaller)), Quad(a) + Quad(b));
  }
}

TEST(DoubleDouble, operationsHoldTheirStatedErrors) {
  RandomDoubles random;
  Worst sum;
  Worst product;
  Worst ratio;
  Worst root;
  Worst squared;
  for (int i = 0; i < kCases; ++i) {
    const DoubleDouble a = random.any();
    const DoubleDouble b = random.any();
    const DoubleDouble c = random.positive();
    sum.add(exact(a + b), exact(a) + exact(b), abs(exact(a)) + abs(exact(b)));
    sum.add(exact(a - b), exact(a) - exact(b), abs(exact(a)) + abs(exact(b)));
    product.add(exact(a * b), exact(a) * exact(b), abs(exact(a) * exact(b)));
    product.add(exact(a.hi * b), Quad(a.hi) * exact(b), abs(Quad(a.hi) * exact(b)));
    ratio.add(exact(a / b), exact(a) / exact(b), abs(exact(a) / exact(b)));
    root.add(exact(sqrt(c)), sqrt(exact(c)), sqrt(exact(c)));
    squared.add(exact(square(a)), exact(a) * exact(a), exact(a) * exact(a));
  }
  EXPECT_LT(sum.value, 0.125);     // measured 0.022
  EXPECT_LT(product.value, 0.25);  // measured 0.034
  EXPECT_LT(ratio.value, 1);       // measured 0.093
  EXPECT_LT(root.value, 1);        // measured 0.038
  EXPECT_LT(squared.value, 0.25);  // measured 0.044
  RecordProperty("worst", std::to_string(sum.value) + " " + std::to_string(product.value) + " " +
                              std::to_string(ratio.value) + " " + std::to_string(root.value) + " " +
                              std::to_string(squared.value));
}

TEST(DoubleDouble, normalizingGathersWhatACancellationLeft) {
  const DoubleDouble third = DoubleDouble(1) / DoubleDouble(3);
  const DoubleDouble rest = normalized(third + third + third - DoubleDouble(1));
  EXPECT_LE(std::fabs(rest.lo), std::fabs(rest.hi) * 0x1p-53);
  EXPECT_LT(std::fabs(rest.hi), 0x1p-100);
}

TEST(DoubleDouble, rootOfZeroIsZero) {
  EXPECT_EQ(sqrt(DoubleDouble(0)).hi, 0);
  EXPECT_EQ(sqrt(DoubleDouble(0)).lo, 0);
}

}  // namespace
}  // namespace careen
