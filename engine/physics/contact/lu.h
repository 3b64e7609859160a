#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace careen {

/// P A = L U of a square matrix in place, row-major, with partial pivoting; `pivots` holds the row that each
/// pivot was taken from. A column of zeros leaves a zero on the diagonal.
inline void factoriseLu(std::span<double> matrix, std::span<std::size_t> pivots) {
  const std::size_t n = pivots.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < n; ++i) {
      if (std::fabs(matrix[i * n + k]) > std::fabs(matrix[best * n + k])) {
        best = i;
      }
    }
    pivots[k] = best;
    if (best != k) {
      for (std::size_t j = 0; j < n; ++j) {
        std::swap(matrix[k * n + j], matrix[best * n + j]);
      }
    }
    const double* row = &matrix[k * n];
    if (row[k] == 0) {
      continue;
    }
    for (std::size_t i = k + 1; i < n; ++i) {
      double* other = &matrix[i * n];
      if (other[k] == 0) {
        continue;
      }
      const double factor = other[k] / row[k];
      other[k] = factor;
      for (std::size_t j = k + 1; j < n; ++j) {
        other[j] -= factor * row[j];
      }
    }
  }
}

/// Solves for x in place, given the factors from factoriseLu.
inline void solveLu(std::span<const double> factors, std::span<const std::size_t> pivots,
                    std::span<double> x) {
  const std::size_t n = x.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::swap(x[k], x[pivots[k]]);
  }
  for (std::size_t i = 1; i < n; ++i) {
    double sum = x[i];
    for (std::size_t k = 0; k < i; ++k) {
      sum -= factors[i * n + k] * x[k];
    }
    x[i] = sum;
  }
  for (std::size_t i = n; i-- > 0;) {
    double sum = x[i];
    for (std::size_t k = i + 1; k < n; ++k) {
      sum -= factors[i * n + k] * x[k];
    }
    x[i] = sum / factors[i * n + i];
  }
}

}  // namespace careen
