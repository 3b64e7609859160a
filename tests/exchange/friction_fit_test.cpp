#include "exchange/friction_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace careen {
namespace {

using Frictions = std::function<double(std::size_t, std::size_t)>;

// As MuJoCo has it.
Frictions largerOf(const std::vector<double>& of) {
  return [of](std::size_t i, std::size_t j) { return std::max(of[i], of[j]); };
}

TEST(FrictionFit, keepsCoefficientsThatFit) {
  const std::vector<double> own = {0.25, 0.36, 0.5};
  const FrictionFit fit = fitFrictions(
      own, {true, true, false}, [&](std::size_t i, std::size_t j) { return std::sqrt(own[i] * own[j]); });
  EXPECT_FALSE(fit.misfit);
  EXPECT_EQ(fit.coefficients, own);
}

// Boxes among themselves 0.5, on the floor 1: sqrt(0.5 μ) = 1.
TEST(FrictionFit, findsARougherFloor) {
  const std::vector<double> own = {1, 0.5, 0.5, 0.5};
  const FrictionFit fit = fitFrictions(own, {false, true, true, true}, largerOf(own));
  EXPECT_FALSE(fit.misfit);
  EXPECT_NEAR(fit.coefficients[0], 2, 1e-12);
  EXPECT_NEAR(fit.coefficients[3], 0.5, 1e-12);
}

TEST(FrictionFit, oneBoxFitsAnyFloors) {
  const std::vector<double> own = {0, 1, 0.3, 0};
  const FrictionFit fit = fitFrictions(own, {true, false, false, false}, largerOf(own));
  EXPECT_FALSE(fit.misfit);
  EXPECT_NEAR(std::sqrt(fit.coefficients[0] * fit.coefficients[2]), 0.3, 1e-12);
  EXPECT_EQ(fit.coefficients[3], 0);
}

TEST(FrictionFit, namesAPairThatFitsNot) {
  // Three of them say what each is; the fourth pair, of 2 and itself, would be another: boxes 1, 0.5, 0.5 and
  // a floor of 0.7 against them.
  const std::vector<double> own = {1, 0.5, 0.5, 0.7};
  const FrictionFit fit = fitFrictions(own, {true, true, true, false}, largerOf(own));
  ASSERT_TRUE(fit.misfit);
  EXPECT_EQ(fit.misfit->second, 3U);
  // A pair without friction of two that have some.
  EXPECT_TRUE(fitFrictions({0.5, 0.5, 0.5}, {true, true, true}, [](std::size_t i, std::size_t j) {
                return i + j == 1 ? 0.0 : 0.5;
              }).misfit);
}

// An arm of three on a rougher floor, whose neighbours pass through each other: only the first and the last
// of them say what the floor has.
TEST(FrictionFit, pairsThatPassThroughEachOtherDoNotCount) {
  const std::vector<double> own = {1, 0.5, 0.5, 0.5};
  const FrictionFit fit = fitFrictions(own, {false, true, true, true}, [&](std::size_t i, std::size_t j) {
    return i + j == 3 && i * j != 0 ? std::nan("") : i + j == 5 ? std::nan("") : std::max(own[i], own[j]);
  });
  EXPECT_FALSE(fit.misfit);
  EXPECT_NEAR(fit.coefficients[0], 2, 1e-12);
  EXPECT_NEAR(fit.coefficients[2], 0.5, 1e-12);
}

TEST(FrictionFit, findsAnyCoefficientsFromTheirPairs) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(0.01, 3);
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t count = 1 + random() % 7;
    std::vector<double> meant;
    std::vector<bool> movable;
    std::vector<bool> isApart;
    for (std::size_t i = 0; i < count; ++i) {
      meant.push_back(random() % 5 == 0 ? 0 : number(random));
      movable.push_back(random() % 2 == 0);
      isApart.push_back(random() % 4 == 0);
    }
    const FrictionFit fit =
        fitFrictions(std::vector<double>(count, 0.9), movable, [&](std::size_t i, std::size_t j) {
          return isApart[i] && isApart[j] ? std::nan("") : std::sqrt(meant[i] * meant[j]);
        });
    EXPECT_FALSE(fit.misfit) << trial;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if ((movable[i] || movable[j]) && !(isApart[i] && isApart[j])) {
          EXPECT_NEAR(std::sqrt(fit.coefficients[i] * fit.coefficients[j]), std::sqrt(meant[i] * meant[j]),
                      1e-11)
              << trial;
        }
      }
    }
  }
}

}  // namespace
}  // namespace careen
