#pragma once

#include <cstddef>
#include <span>

namespace careen {

/// L D Lᵀ of a positive definite n × n matrix in place, row-major; only the lower triangle is read and
/// written. No pivoting: none is needed, and choosing among equal pivots would decide the rounding.
inline void factoriseLdl(std::span<double> matrix, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    double* row = &matrix[i * n];
    for (std::size_t j = 0; j < i; ++j) {
      const double* other = &matrix[j * n];
      double sum = row[j];
      for (std::size_t k = 0; k < j; ++k) {
        sum -= row[k] * other[k];
      }
      row[j] = sum;  // L D for now
    }
    double pivot = row[i];
    for (std::size_t j = 0; j < i; ++j) {
      const double factor = row[j] / matrix[j * n + j];
      pivot -= factor * row[j];
      row[j] = factor;
    }
    row[i] = pivot;
  }
}

/// Solves for x in place, given the factors from factoriseLdl.
inline void solveLdl(std::span<const double> factors, std::span<double> x) {
  const std::size_t n = x.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      x[i] -= factors[i * n + k] * x[k];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    x[i] /= factors[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) {
      x[i] -= factors[k * n + i] * x[k];
    }
  }
}

}  // namespace careen
