#pragma once

#include <cmath>

namespace careen {

/// An unevaluated sum of two doubles, where lo is of the order of the rounding error of hi: about 32 digits
/// instead of 16.
///
/// It is meant for the few quantities that are multiplied by time: an angular rate known to 16 digits is off
/// by a whole microradian after 10¹⁰ radians. Only + − * / sqrt are used (no fused multiply-add), which gives
/// the same bits everywhere.
///
/// hi is what plain double arithmetic would give, and lo the first-order sum of its rounding errors. Results
/// are not renormalised to |lo| ≤ ulp(hi)/2 after each operation, so the chain of hi values runs at the speed
/// of plain doubles and the lo values follow. Call normalized() after a difference that may have cancelled.
/// Relative errors are stated for normalised arguments; for + and − they are relative to |a| + |b|.
///
/// T. J. Dekker, "A floating-point technique for extending the available precision", Numer. Math. 18, 1971;
/// D. E. Knuth, The Art of Computer Programming 2, 4.2.2, theorem B (twoSum).
struct DoubleDouble {
  double hi;
  double lo;

  DoubleDouble() = default;                                   // uninitialised, like a double
  constexpr DoubleDouble(double value) : hi(value), lo(0) {}  // NOLINT: numbers convert, like int to double
  constexpr DoubleDouble(double high, double low) : hi(high), lo(low) {}
  constexpr explicit operator double() const { return hi + lo; }
};

/// a + b without error.
constexpr DoubleDouble twoSum(double a, double b) {
  const double sum = a + b;
  const double bRounded = sum - a;
  const double aRounded = sum - bRounded;
  return {sum, (a - aRounded) + (b - bRounded)};
}

/// a + b without error, for |a| ≥ |b| or a = 0.
constexpr DoubleDouble fastTwoSum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a as a sum of two numbers of at most 26 bits each, whose products are exact. |a| < 2⁹⁹⁶.
constexpr DoubleDouble split(double a) {
  constexpr double kTwo27Plus1 = 134217729.0;
  const double shifted = kTwo27Plus1 * a;
  const double high = shifted - (shifted - a);
  return {high, a - high};
}

/// a * b without error, unless it underflows.
constexpr DoubleDouble twoProduct(double a, double b) {
  const double product = a * b;
  const DoubleDouble x = split(a);
  const DoubleDouble y = split(b);
  return {product, ((x.hi * y.hi - product) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo};
}

/// a² without error, unless it underflows.
constexpr DoubleDouble twoSquare(double a) {
  const double square = a * a;
  const DoubleDouble x = split(a);
  return {square, ((x.hi * x.hi - square) + 2 * (x.hi * x.lo)) + x.lo * x.lo};
}

/// The same number with |lo| ≤ ulp(hi)/2.
constexpr DoubleDouble normalized(const DoubleDouble& a) { return twoSum(a.hi, a.lo); }

constexpr DoubleDouble operator-(const DoubleDouble& a) { return {-a.hi, -a.lo}; }

constexpr DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {  // error < 2⁻¹⁰³
  const DoubleDouble sum = twoSum(a.hi, b.hi);
  return {sum.hi, sum.lo + (a.lo + b.lo)};
}

constexpr DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + (-b); }

constexpr DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {  // error < 2⁻¹⁰²
  const DoubleDouble product = twoProduct(a.hi, b.hi);
  return {product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi)};
}

constexpr DoubleDouble operator*(double a, const DoubleDouble& b) {  // error < 2⁻¹⁰²
  const DoubleDouble product = twoProduct(a, b.hi);
  return {product.hi, product.lo + a * b.lo};
}

constexpr DoubleDouble operator*(const DoubleDouble& a, double b) { return b * a; }

constexpr DoubleDouble square(const DoubleDouble& a) {  // error < 2⁻¹⁰²
  const DoubleDouble hiSquared = twoSquare(a.hi);
  return {hiSquared.hi, hiSquared.lo + 2 * (a.hi * a.lo)};
}

constexpr DoubleDouble half(const DoubleDouble& a) { return {0.5 * a.hi, 0.5 * a.lo}; }

/// a / b, given 1 / b.hi to rounding: several quotients by one b share the division.
constexpr DoubleDouble quotient(const DoubleDouble& a, const DoubleDouble& b,
                                double inverse) {  // error < 2⁻¹⁰⁰
  const double ratio = a.hi * inverse;
  const DoubleDouble product = twoProduct(ratio, b.hi);
  return {ratio, (((a.hi - product.hi) - product.lo) + (a.lo - ratio * b.lo)) * inverse};
}

constexpr DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  return quotient(a, b, 1 / b.hi);
}

/// a ≥ 0.
inline DoubleDouble sqrt(const DoubleDouble& a) {  // error < 2⁻¹⁰⁰
  const double root = std::sqrt(a.hi);
  if (root == 0) {
    return {0, 0};
  }
  const DoubleDouble rootSquared = twoSquare(root);
  return {root, (((a.hi - rootSquared.hi) - rootSquared.lo) + a.lo) / (2 * root)};
}

}  // namespace careen
