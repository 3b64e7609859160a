#include "physics/impact/secant_iteration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace careen {
namespace {

/// Steps until x and g(x) agree to 1e-12.
template <class Function>
int stepsToAgree(std::vector<double> x, const Function& function) {
  SecantIteration iteration(x.size());
  for (int k = 0; k < 100; ++k) {
    const std::vector<double> g = function(x);
    double change = 0;
    for (std::size_t c = 0; c < x.size(); ++c) {
      change = std::max(change, std::fabs(g[c] - x[c]));
    }
    if (change < 1e-12) {
      return k;
    }
    iteration.step(x, g, 1);
  }
  return 100;
}

TEST(SecantIteration, isThereInTwoStepsWhereOneRateRules) {
  for (const double rate : {-3.0, -1.0, -0.5, 0.01, 0.9}) {  // plain iteration: for ever, for −1 and −3
    const auto g = [rate](const std::vector<double>& x) {
      return std::vector<double>{1 + rate * (x[0] - 1), 2 + rate * (x[1] - 2)};
    };
    EXPECT_LE(stepsToAgree({5, -4}, g), 3) << rate;
  }
}

TEST(SecantIteration, agreesSoonWhereRatesDiffer) {
  const auto g = [](const std::vector<double>& x) {
    return std::vector<double>{1 + 0.5 * (x[0] - 1) * (x[0] - 1) - 0.2 * (x[1] - 2), 2 - 0.4 * (x[0] - 1)};
  };
  EXPECT_LE(stepsToAgree({1.5, 1.5}, g), 20);
}

TEST(SecantIteration, orderOfTheNumbersChangesNoBit) {
  std::vector<double> x = {1.1, 2.3, 0.7, 5.9};
  std::vector<double> y(x.rbegin(), x.rend());
  SecantIteration forward(4);
  SecantIteration backward(4);
  for (int k = 0; k < 5; ++k) {
    std::vector<double> gx;
    std::vector<double> gy;
    for (std::size_t c = 0; c < 4; ++c) {
      gx.push_back(std::sqrt(x[c] + 1));
      gy.push_back(std::sqrt(y[c] + 1));
    }
    forward.step(x, gx, 1);
    backward.step(y, gy, 1);
    EXPECT_EQ(std::vector<double>(x.rbegin(), x.rend()), y);
  }
}

}  // namespace
}  // namespace careen
