#pragma once

#include <type_traits>

#include "core/math/double_double.h"

namespace careen {

/// The type for quantities that are multiplied by time: twice the digits for double, otherwise the type
/// itself. The functions below provide the operations of double_double.h for every scalar type.
template <class Real>
struct Widened {
  using Type = Real;
};
template <>
struct Widened<double> {
  using Type = DoubleDouble;
};
template <class Real>
using Wide = typename Widened<Real>::Type;

template <class Number>
constexpr const Number& normalized(const Number& x) {
  return x;
}

template <class Number>
constexpr Number half(const Number& x) {
  return x / 2;
}

template <class Number>
constexpr Number square(const Number& x) {
  return x * x;
}

/// a − b and a * b of two plain numbers, in the wide type.
template <class Number, class Real>
constexpr Number wideDifference(const Real& a, const Real& b) {
  if constexpr (std::is_same_v<Number, DoubleDouble>) {
    return twoSum(a, -b);
  } else {
    return a - b;
  }
}

template <class Number, class Real>
constexpr Number wideProduct(const Real& a, const Real& b) {
  if constexpr (std::is_same_v<Number, DoubleDouble>) {
    return twoProduct(a, b);
  } else {
    return a * b;
  }
}

/// a + b, where b is of the order of the rounding error of a.
template <class Number, class Real>
constexpr Number withRest(const Number& a, const Real& b) {
  if constexpr (std::is_same_v<Number, DoubleDouble>) {
    return {a.hi, a.lo + b};
  } else {
    return a + b;
  }
}

/// a / b given leadingInverse(b).
template <class Number>
constexpr Number quotient(const Number& a, const Number&, const Number& inverse) {
  return a * inverse;
}

/// 1 / b, or 1 / b.hi for a double-double b.
template <class Real, class Number>
constexpr Real leadingInverse(const Number& b) {
  if constexpr (std::is_same_v<Number, DoubleDouble>) {
    return 1 / b.hi;
  } else {
    return 1 / b;
  }
}

}  // namespace careen
