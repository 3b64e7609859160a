#include "physics/contact/lu.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace careen {
namespace {

TEST(Lu, solvesWhatNeedsPivots) {
  // The first pivot vanishes, and rows change places twice.
  const std::vector<double> matrix = {0, 2, 1, -1, 1, 0, 3, 2, 4, -2, 1, 0, 2, 2, 0, 1};
  const std::vector<double> x = {1, -2, 3, 0.5};
  std::vector<double> b(4, 0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      b[i] += matrix[4 * i + j] * x[j];
    }
  }
  std::vector<double> factors = matrix;
  std::vector<std::size_t> pivots(4);
  factoriseLu(factors, pivots);
  solveLu(factors, pivots, b);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(b[i], x[i], 1e-14);
  }
}

}  // namespace
}  // namespace careen
