#include "core/math/order_free_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "support/impact_scene.h"

namespace careen {
namespace {

using test::Quad;
using test::Random;

double orderFreeSum(const std::vector<double>& terms) {
  std::vector<std::array<double, 1>> columns;
  columns.reserve(terms.size());
  for (const double term : terms) {
    columns.push_back({term});
  }
  return orderFreeSums<1>(columns)[0];
}

std::vector<double> randomTerms(Random& random) {
  std::vector<double> terms;
  const int count = random.below(40);
  terms.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    terms.push_back(random.between(-1, 1) * std::ldexp(1.0, random.below(80) - 40));
  }
  return terms;
}

TEST(OrderFreeSum, everyOrderGivesTheSameBits) {
  Random random(1);
  for (int k = 0; k < 20000; ++k) {
    std::vector<double> terms = randomTerms(random);
    const double sum = orderFreeSum(terms);
    std::reverse(terms.begin(), terms.end());
    ASSERT_EQ(orderFreeSum(terms), sum);
    std::sort(terms.begin(), terms.end());
    ASSERT_EQ(orderFreeSum(terms), sum);
  }
}

TEST(OrderFreeSum, negatedTermsGiveTheNegatedSum) {
  Random random(2);
  for (int k = 0; k < 20000; ++k) {
    std::vector<double> terms = randomTerms(random);
    const double sum = orderFreeSum(terms);
    for (double& term : terms) {
      term = -term;
    }
    ASSERT_EQ(orderFreeSum(terms), -sum);
  }
}

TEST(OrderFreeSum, pairsThatCancelCancelToZero) {
  Random random(3);
  int running = 0;
  for (int k = 0; k < 20000; ++k) {
    std::vector<double> terms = randomTerms(random);
    const std::size_t half = terms.size();
    for (std::size_t i = 0; i < half; ++i) {
      terms.push_back(-terms[i]);
    }
    ASSERT_EQ(orderFreeSum(terms), 0);
    double sum = 0;
    for (const double term : terms) {
      sum += term;
    }
    running += sum != 0 ? 1 : 0;
  }
  EXPECT_GT(running, 10000);  // a running sum misses it nearly always
}

TEST(OrderFreeSum, isRightToTheLastBitWhereNothingCancels) {
  Random random(4);
  for (int k = 0; k < 20000; ++k) {
    std::vector<double> terms = randomTerms(random);
    Quad exact = 0;
    double largest = 0;
    for (const double term : terms) {
      exact += Quad(term);
      largest = std::max(largest, std::fabs(term));
    }
    const double sum = orderFreeSum(terms);
    const double error = std::fabs(static_cast<double>(Quad(exact - Quad(sum))));
    ASSERT_LE(error, 0x1p-53 * std::fabs(sum) + 40 * 0x1p-90 * largest);
  }
}

TEST(OrderFreeSum, manySumsAreThoseOfEachAlone) {
  Random random(5);
  for (int k = 0; k < 2000; ++k) {
    std::array<std::vector<double>, 3> columns;
    const std::vector<double> terms = randomTerms(random);
    std::vector<std::array<double, 3>> rows;
    for (const double term : terms) {
      rows.push_back({term, random.between(-1, 1) / term, random.below(3) == 0 ? term * term : 0});
      for (std::size_t i = 0; i < 3; ++i) {
        columns[i].push_back(rows.back()[i]);
      }
    }
    const std::array<double, 3> sums = orderFreeSums<3>(rows);
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_EQ(sums[i], orderFreeSum(columns[i]));
    }
  }
}

TEST(OrderFreeSum, ofNothingIsZero) {
  EXPECT_EQ(orderFreeSum({}), 0);
  EXPECT_EQ(orderFreeSum({0, 0, 0, 0}), 0);
}

}  // namespace
}  // namespace careen
