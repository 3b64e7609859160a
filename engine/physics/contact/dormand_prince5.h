#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace careen {

/// Explicit Runge–Kutta method of order 5 with an embedded one of order 4 (J. R. Dormand, P. J. Prince, J.
/// Comput. Appl. Math. 6, 1980): six evaluations per step, the seventh is the next step's first.
class DormandPrince5 {
 public:
  using State = std::vector<double>;

  /// Computes y(h) from y and its derivative there; rate(y, dy) computes derivatives.
  template <class Rate>
  void step(const State& y, const State& derivative, double h, const Rate& rate, State& next) {
    stages_[0] = derivative;
    next.resize(y.size());
    for (std::size_t s = 0; s < kWeights.size(); ++s) {
      for (std::size_t k = 0; k < y.size(); ++k) {
        double sum = 0;
        for (std::size_t j = 0; j <= s; ++j) {
          sum += kWeights[s][j] * stages_[j][k];
        }
        next[k] = y[k] + h * sum;
      }
      if (s + 1 < kWeights.size()) {
        stages_[s + 1].resize(y.size());
        rate(next, stages_[s + 1]);
      }
    }
  }

  /// Error estimate: the difference from the embedded method's result, given the derivative at the step's
  /// end.
  void error(double h, const State& derivativeAtEnd, State& difference) const {
    difference.resize(derivativeAtEnd.size());
    for (std::size_t k = 0; k < difference.size(); ++k) {
      double sum = kErrorWeights[6] * derivativeAtEnd[k];
      for (std::size_t j = 0; j < 6; ++j) {
        sum += kErrorWeights[j] * stages_[j][k];
      }
      difference[k] = h * sum;
    }
  }

 private:
  static constexpr std::array<std::array<double, 6>, 6> kWeights = {{
      {1.0 / 5},
      {3.0 / 40, 9.0 / 40},
      {44.0 / 45, -56.0 / 15, 32.0 / 9},
      {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
      {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
      {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84},
  }};
  static constexpr std::array<double, 7> kErrorWeights = {
      71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};

  std::array<State, 6> stages_;
};

}  // namespace careen
