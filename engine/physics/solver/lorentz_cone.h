#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace careen::lorentz {

/// Algebra of the cone |x_t| ≤ x_0 in three dimensions: F. Alizadeh, D. Goldfarb, Second-order cone
/// programming, Math. Program. 95, 2003. J = diag(1, −1, −1).
using Vector = std::array<double, 3>;

inline double dot(const Vector& x, const Vector& y) { return x[0] * y[0] + (x[1] * y[1] + x[2] * y[2]); }
inline double tangentialSize(const Vector& x) { return std::sqrt(x[1] * x[1] + x[2] * x[2]); }

/// xᵀJx = (x_0 − |x_t|)(x_0 + |x_t|), > 0 inside.
inline double determinant(const Vector& x) {
  const double size = tangentialSize(x);
  return (x[0] - size) * (x[0] + size);
}

/// x ∘ y = (x·y, x_0 y_t + y_0 x_t).
inline Vector product(const Vector& x, const Vector& y) {
  return {dot(x, y), x[0] * y[1] + y[0] * x[1], x[0] * y[2] + y[0] * x[2]};
}

/// z with x ∘ z = y.
inline Vector quotient(const Vector& x, const Vector& y) {
  const double first = (x[0] * y[0] - (x[1] * y[1] + x[2] * y[2])) / determinant(x);
  return {first, (y[1] - first * x[1]) / x[0], (y[2] - first * x[2]) / x[0]};
}

/// Scaling of Nesterov and Todd: W² = η² (2 w̄w̄ᵀ − J) with W² w = r, for r and w inside. Sets w̄, returns η².
inline double scalingPoint(const Vector& r, const Vector& w, Vector& point) {
  const double lengthR = std::sqrt(determinant(r));
  const double lengthW = std::sqrt(determinant(w));
  const double cosine = dot(r, w) / (lengthR * lengthW);
  const double norm = 1 / std::sqrt(2 * (1 + cosine));
  point = {(r[0] / lengthR + w[0] / lengthW) * norm, (r[1] / lengthR - w[1] / lengthW) * norm,
           (r[2] / lengthR - w[2] / lengthW) * norm};
  return lengthR / lengthW;
}

/// W² x.
inline Vector scaledTwice(const Vector& point, double size2, const Vector& x) {
  const double along = 2 * dot(point, x);
  return {size2 * (along * point[0] - x[0]), size2 * (along * point[1] + x[1]),
          size2 * (along * point[2] + x[2])};
}

/// W x; `size` is η.
inline Vector scaledOnce(const Vector& point, double size, const Vector& x) {
  const double along = point[1] * x[1] + point[2] * x[2];
  const double factor = x[0] + along / (1 + point[0]);
  return {size * (point[0] * x[0] + along), size * (x[1] + factor * point[1]),
          size * (x[2] + factor * point[2])};
}

/// Largest α with x + α d in the cone, for x inside.
inline double reach(const Vector& x, const Vector& d) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const double a = d[0] * d[0] - (d[1] * d[1] + d[2] * d[2]);
  const double b = x[0] * d[0] - (x[1] * d[1] + x[2] * d[2]);
  const double c = determinant(x);
  // b² ≥ a c by the reversed inequality of Cauchy and Schwarz; what rounding errors leave below 0 is 0.
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  if (b < 0) {
    return c / (root - b);
  }
  return a < 0 ? (b + root) / -a : kFar;
}

}  // namespace careen::lorentz
