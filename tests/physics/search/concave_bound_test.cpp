#include "physics/search/concave_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/tumbling_box.h"

namespace careen {
namespace {

TEST(ConcaveBound, rootsOfParabolasByHand) {
  EXPECT_EQ(firstRoot(3, -3, 0, 99), 1);    // 3 − 3δ
  EXPECT_EQ(firstRoot(2, 1, 2, 99), 2);     // 2 + δ − δ²
  EXPECT_EQ(firstRoot(4, 0, 2, 99), 2);     // 4 − δ²
  EXPECT_EQ(firstRoot(2, -3, -2, 99), 1);   // 2 − 3δ + δ²: the first of 1 and 2
  EXPECT_EQ(firstRoot(2, -1, -2, 99), 99);  // 2 − δ + δ² stays above
  EXPECT_EQ(firstRoot(1, 1, 0, 99), 99);
  EXPECT_EQ(firstRoot(1, 1, -1, 99), 99);
}

struct Term {
  double weight = 0;
  double value = 0;
  double rate = 0;
};

// Against the definition, sampled: positive up to the answer, not after.
TEST(ConcaveBound, firstReachIsTheFirstRootOfTheDefinition) {
  test::Dice dice(31);
  int reached = 0;
  for (int k = 0; k < 20000; ++k) {
    const double rate = dice.between(-2, 2);
    const double curvature = k % 5 == 0 ? 0 : dice.between(0, 4);
    std::vector<Term> terms;
    double level = dice.between(0.01, 1);
    for (int i = 0; i < k % 7; ++i) {
      terms.push_back(
          {.weight = dice.between(0, 1), .value = dice.between(-1, 1), .rate = dice.between(-3, 3)});
      level += terms.back().weight * std::fabs(terms.back().value);
    }
    ConcaveBound bound(level, rate, curvature);
    for (std::size_t i = 0; i < terms.size(); ++i) {
      if (i == 2) {
        bound.beginSecondBox();
      }
      bound.addKink(terms[i].weight, terms[i].value, terms[i].rate);
    }
    const auto definition = [&](double t) {
      double sum = level + rate * t - 0.5 * curvature * t * t;
      for (const Term& term : terms) {
        sum -= term.weight * std::fabs(term.value + term.rate * t);
      }
      return sum;
    };
    EXPECT_NEAR(bound.value(), definition(0), 1e-15);
    const double most = 3;
    const double reach = bound.firstReach(0, most);
    for (int i = 0; i < 20; ++i) {
      ASSERT_GT(definition(reach * i / 20), -1e-14);
    }
    if (reach < most) {
      ASSERT_NEAR(definition(reach), 0, 2e-14);  // measured 6e-15
      ++reached;
    }
    // The slope ahead is that of the definition.
    EXPECT_NEAR((definition(1e-7) - definition(0)) / 1e-7, bound.rateAhead(0), 1e-5);
  }
  EXPECT_GT(reached, 10000);
}

TEST(ConcaveBound, aTieCountsOnTheWorseSide) {
  ConcaveBound bound(1, 0, 0);
  bound.addKink(1, 1e-10, -2);
  EXPECT_EQ(bound.rateAhead(0), 2);
  EXPECT_EQ(bound.rateAhead(1e-9), -2);
}

}  // namespace
}  // namespace careen
