#include "physics/impact/ldl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/impact_scene.h"

namespace careen {
namespace {

TEST(Ldl, solvesWhatIsPositiveDefinite) {
  testing::Random random(1);
  double worst = 0;
  for (int round = 0; round < 200; ++round) {
    const std::size_t n = 1 + static_cast<std::size_t>(random.below(24));
    std::vector<double> root(n * n);
    for (double& value : root) {
      value = random.between(-1, 1);
    }
    std::vector<double> matrix(n * n);  // root · rootᵀ + 1
    std::vector<double> right(n);
    std::vector<double> expected(n);
    for (double& value : expected) {
      value = random.between(-1, 1);
    }
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        matrix[i * n + j] = i == j ? 1 : 0;
        for (std::size_t k = 0; k < n; ++k) {
          matrix[i * n + j] += root[i * n + k] * root[j * n + k];
        }
        right[i] += matrix[i * n + j] * expected[j];
      }
    }
    for (std::size_t i = 0; i < n; ++i) {  // above the diagonal nothing is read
      std::fill_n(&matrix[i * n] + i + 1, n - i - 1, 1e300);
    }
    factoriseLdl(matrix, n);
    solveLdl(matrix, right);
    for (std::size_t i = 0; i < n; ++i) {
      worst = std::max(worst, std::fabs(right[i] - expected[i]));
    }
  }
  EXPECT_LT(worst, 1e-13);
  RecordProperty("worst", std::to_string(worst * 1e16) + "e-16");
}

}  // namespace
}  // namespace careen
