#include "physics/solver/block_lu.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

namespace careen {
namespace {

constexpr std::size_t kSize = BlockLu::kSize;
using Edges = std::vector<std::pair<int, int>>;

// A x = b for a matrix with the pattern of a graph, unsymmetric, its diagonal dominant: x is what b was made
// from.
void expectSolves(int rows, const Edges& edges) {
  BlockLu lu;
  lu.setPattern(static_cast<std::size_t>(rows), edges);
  lu.setZero();
  std::mt19937 generator(5);
  const auto number = [&] { return static_cast<double>(generator()) * 0x1p-31 - 1; };
  std::vector<double> x(static_cast<std::size_t>(rows) * kSize);
  for (double& part : x) {
    part = number();
  }
  std::vector<double> b(x.size());
  const auto fill = [&](int i, int j) {
    BlockLu::Block& block = lu.block(lu.find(i, j));
    for (std::size_t k = 0; k < kSize * kSize; ++k) {
      block[k] = number() + (i == j && k % (kSize + 1) == 0 ? 30 : 0);
      b[static_cast<std::size_t>(i) * kSize + k / kSize] +=
          block[k] * x[static_cast<std::size_t>(j) * kSize + k % kSize];
    }
  };
  for (int i = 0; i < rows; ++i) {
    fill(i, i);
  }
  for (const auto& [i, j] : edges) {
    fill(i, j);
    fill(j, i);
  }
  ASSERT_TRUE(lu.factorise());
  lu.solve(b);
  for (std::size_t k = 0; k < x.size(); ++k) {
    EXPECT_NEAR(b[k], x[k], 1e-14);
  }
}

TEST(BlockLu, solves) {
  expectSolves(1, {});
  expectSolves(2, {{0, 1}});
  expectSolves(3, {});
  expectSolves(5, {{1, 0}, {1, 2}, {3, 2}, {3, 4}});          // a chain
  expectSolves(5, {{0, 1}, {0, 2}, {0, 3}, {0, 4}});          // all fill after the first
  expectSolves(6, {{0, 3}, {1, 4}, {2, 5}, {0, 5}, {3, 4}});  // fill of fill
}

TEST(BlockLu, keepsToThePattern) {
  BlockLu lu;
  const Edges chain{{0, 1}, {1, 0}, {1, 2}};
  lu.setPattern(3, chain);
  EXPECT_EQ(lu.find(0, 1), lu.find(0, 1));
  EXPECT_NE(lu.find(0, 1), lu.find(1, 0));
  EXPECT_NE(lu.find(1, 2), lu.find(2, 1));
  EXPECT_EQ(lu.diagonal(2), lu.find(2, 2));
}

// Against Eigen's dense determinants, of both signs.
TEST(BlockLu, knowsTheSignOfTheDeterminant) {
  std::mt19937 generator(7);
  const auto number = [&] { return static_cast<double>(generator()) * 0x1p-31 - 1; };
  int negative = 0;
  for (int round = 0; round < 300; ++round) {
    BlockLu lu;
    const Edges edges{{0, 1}, {1, 2}};
    lu.setPattern(3, edges);
    lu.setZero();
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(18, 18);
    const auto fill = [&](int i, int j) {
      BlockLu::Block& block = lu.block(lu.find(i, j));
      for (std::size_t k = 0; k < kSize * kSize; ++k) {
        block[k] = number() + (i == j && k % (kSize + 1) == 0 ? 1 : 0);
        dense(i * 6 + static_cast<int>(k / kSize), j * 6 + static_cast<int>(k % kSize)) = block[k];
      }
    };
    for (int i = 0; i < 3; ++i) {
      fill(i, i);
    }
    for (const auto& [i, j] : edges) {
      fill(i, j);
      fill(j, i);
    }
    ASSERT_TRUE(lu.factorise());
    EXPECT_EQ(lu.isNegative(), dense.determinant() < 0) << round;
    negative += lu.isNegative() ? 1 : 0;
  }
  EXPECT_GT(negative, 50);
  EXPECT_LT(negative, 250);
}

TEST(BlockLu, zeroPivotIsReported) {
  BlockLu lu;
  lu.setPattern(1, {});
  lu.setZero();
  EXPECT_FALSE(lu.factorise());
}

}  // namespace
}  // namespace careen
