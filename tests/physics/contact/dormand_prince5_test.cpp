#include "physics/contact/dormand_prince5.h"

#include <gtest/gtest.h>

#include <cmath>

namespace careen {
namespace {

using State = DormandPrince5::State;

// y = tan t solves ẏ = 1 + y²: not linear, so that a wrong coefficient shows.
void rate(const State& y, State& dy) { dy = {1 + y[0] * y[0]}; }
constexpr double kEnd = 0.5;

struct Errors {
  double result = 0;
  double embedded = 0;
};
Errors after(int steps) {
  const double h = kEnd / steps;
  DormandPrince5 method;
  State y = {0};
  State dy;
  Errors errors;
  for (int k = 0; k < steps; ++k) {
    rate(y, dy);
    State next;
    method.step(y, dy, h, rate, next);
    State at;
    rate(next, at);
    State difference;
    method.error(h, at, difference);
    errors.embedded = std::max(errors.embedded, std::fabs(difference[0]));
    y = next;
  }
  errors.result = std::fabs(y[0] - std::tan(kEnd));
  return errors;
}

TEST(DormandPrince5, isOfFifthOrderWithAnErrorOfFifth) {
  const Errors coarse = after(16);
  const Errors fine = after(32);
  EXPECT_NEAR(std::log2(coarse.result / fine.result), 5, 0.3);
  EXPECT_NEAR(std::log2(coarse.embedded / fine.embedded), 5, 0.3);
  EXPECT_LT(fine.result, 1e-8);
}

}  // namespace
}  // namespace careen
