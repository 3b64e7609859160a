#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <type_traits>

#include "core/math/double_double.h"
#include "core/math/to_integer.h"

/// sin, cos, exp, log and atan2 from + − * / sqrt and bit patterns alone.
///
/// The C library selects code by processor (with or without fused multiply-add), which changes the last bit
/// of the result. These functions give the same bits wherever IEEE 754 arithmetic is available, and are
/// accurate to 1 ulp.
///
/// Each function is the textbook scheme: reduce the argument to a short interval, with the rounding error of
/// the reduction in a second double; sum a Taylor series there; undo the reduction. J.-M. Muller, Elementary
/// Functions, ch. 11.
///
/// For any other scalar type the same names call the functions of that type.
namespace careen::elementary {

template <class Real>
struct SinCos {
  Real sin;
  Real cos;
};

namespace detail {

/// 2ⁿ for −1022 ≤ n ≤ 1023.
inline double powerOfTwo(int n) { return std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52U); }

/// 1.5·2⁵²: adding it rounds to a whole number, which is in the low bits as a two's complement.
inline constexpr double kWholeNumberShift = 6755399441055744.0;

/// x − n·π/2 as hi + lo, for the n nearest to 2x/π. |x| < 2⁵⁰.
inline DoubleDouble reducedByQuarterTurns(double x, double n) {
  if (std::fabs(n) < 0x1p27) {
    // π/2 in pieces of 26 bits: their products with n are exact, and so is the first difference.
    const double first = x - n * 0x1.921fb5p+0;
    const DoubleDouble second = twoSum(first, -(n * 0x1.110b46p-26));
    const DoubleDouble third = twoSum(second.hi, -(n * 0x1.1a6263p-54));
    return fastTwoSum(third.hi, (third.lo + second.lo) - n * 0x1.8a2e03707344ap-81);
  }
  const DoubleDouble first = twoProduct(n, 0x1.921fb54442d18p+0);
  const DoubleDouble second = twoProduct(n, 0x1.1a62633145c07p-54);
  const DoubleDouble coarse = twoSum(x - first.hi, -first.lo);
  const DoubleDouble fine = twoSum(coarse.hi, -second.hi);
  return fastTwoSum(fine.hi, (fine.lo + coarse.lo) - (second.lo - n * 0x1.f1976b7ed8fbcp-110));
}

/// Two doubles for two results at once; the operations are bit for bit those of single doubles.
using Pair = double __attribute__((vector_size(16)));
using PairBits = std::uint64_t __attribute__((vector_size(16)));

template <class Number>
struct Bits {
  using Type = std::uint64_t;
};
template <>
struct Bits<Pair> {
  using Type = PairBits;
};

/// Taylor series for |x| ≤ π/4 (slightly more is harmless); first omitted terms: x¹⁹/19!, x¹⁸/18!.
template <class Number>
struct SinCosTails {
  Number square;  // z = x²
  Number sin;     // (sin x − x)/x³
  Number cos;     // (cos x − 1 + z/2)/z²

  explicit SinCosTails(const Number& x) : square(x * x) {
    const Number z = square;
    const Number z2 = z * z;
    const Number z4 = z2 * z2;
    sin = ((-1.0 / 6 + z * (1.0 / 120)) + z2 * (-1.0 / 5040 + z * (1.0 / 362880))) +
          z4 * ((-1.0 / 39916800 + z * (1.0 / 6227020800)) +
                z2 * (-1.0 / 1307674368000 + z * (1.0 / 355687428096000)));
    cos = ((1.0 / 24 + z * (-1.0 / 720)) + z2 * (1.0 / 40320 + z * (-1.0 / 3628800))) +
          z4 * ((1.0 / 479001600 + z * (-1.0 / 87178291200)) + z2 * (1.0 / 20922789888000));
  }
};

/// For an angle given as hi + lo; both results to 1 ulp.
inline SinCos<double> sinCosNearZero(const DoubleDouble& x) {
  const SinCosTails<double> tail(x.hi);
  const double halfSquare = 0.5 * tail.square;
  const double coarse = 1 - halfSquare;
  return {x.hi + (x.hi * tail.square * tail.sin + x.lo * coarse),
          coarse + (((1 - coarse) - halfSquare) + (tail.square * tail.square * tail.cos - x.hi * x.lo))};
}

/// For an angle whose error is itself a rounding of 1.
template <class Number>
SinCos<Number> sinCosNearZero(const Number& x) {
  const SinCosTails<Number> tail(x);
  return {x + x * tail.square * tail.sin, (1 - 0.5 * tail.square) + tail.square * tail.square * tail.cos};
}

/// The angle plus a whole number of quarter turns; by bits, because a branch on the quadrant is mispredicted
/// half the time.
template <class Number>
SinCos<Number> rotatedByQuarterTurns(const SinCos<Number>& start, const Number& quarterTurns) {
  using B = typename Bits<Number>::Type;
  const B quadrant = std::bit_cast<B>(quarterTurns + kWholeNumberShift);
  const B sin = std::bit_cast<B>(start.sin);
  const B cos = std::bit_cast<B>(start.cos);
  const B exchange = (sin ^ cos) & (0 - (quadrant & 1U));
  return {std::bit_cast<Number>(sin ^ exchange ^ ((quadrant & 2U) << 62U)),
          std::bit_cast<Number>(cos ^ exchange ^ (((quadrant + 1U) & 2U) << 62U))};
}

}  // namespace detail

/// The whole number nearest to x. |x| < 2⁵¹.
constexpr double nearestInteger(double x) {
  return (x + detail::kWholeNumberShift) - detail::kWholeNumberShift;
}

/// Sine and cosine of x [rad]. To 1 ulp for |x| < 2²⁷; from there to 2⁵⁰ (where neighbouring doubles are a
/// quarter radian apart) to 1 ulp too except within 2⁻²⁰ of a zero; beyond 2⁵⁰ not a number.
inline SinCos<double> sinCos(double x) {
  if (!std::isless(std::fabs(x), 0x1p50)) {  // < would raise the flag for invalid operations
    return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  }
  const double n = nearestInteger(x * 0x1.45f306dc9c883p-1);
  return detail::rotatedByQuarterTurns(detail::sinCosNearZero(detail::reducedByQuarterTurns(x, n)), n);
}

/// Sine and cosine of `quarterTurns` (a whole number below 2⁵¹) times π/2 plus `rest` [rad], |rest| < 0.8:
/// for phases that are counted in turns, where nothing is left to reduce. To a rounding of 1.
inline SinCos<double> sinCosQuarterTurns(double quarterTurns, double rest) {
  return detail::rotatedByQuarterTurns(detail::sinCosNearZero(rest), quarterTurns);
}

/// e^x. 0 below −708 (where the result would lose digits), infinite above 709.78.
inline double exp(double x) {
  if (!std::islessequal(x, 709.782712893384)) {
    return std::isgreater(x, 0.0) ? std::numeric_limits<double>::infinity() : x;  // or not a number
  }
  if (x < -708) {
    return 0;
  }
  const double n = nearestInteger(x * 0x1.71547652b82fep+0);
  const double coarse = x - n * 0x1.62e42fefa2p-1;  // exact: ln 2 cut to 40 bits times at most 11 bits
  const double cut = n * 0x1.9ef35793c7673p-41;     // the rest of ln 2
  const double r = coarse - cut;                    // |r| ≤ ln(2)/2
  const double rLost = (coarse - r) - cut;
  const double r2 = r * r;
  const double r4 = r2 * r2;
  const double tail =
      ((0.5 + r * (1.0 / 6)) + r2 * (1.0 / 24 + r * (1.0 / 120))) +
      r4 * (((1.0 / 720 + r * (1.0 / 5040)) + r2 * (1.0 / 40320 + r * (1.0 / 362880))) +
            r4 * ((1.0 / 3628800 + r * (1.0 / 39916800)) + r2 * (1.0 / 479001600 + r * (1.0 / 6227020800))));
  const double mantissa = 1 + (r + (rLost + r2 * tail));
  const int half = static_cast<int>(n) / 2;  // in two steps: 2¹⁰²⁴ is out of range
  return mantissa * detail::powerOfTwo(half) * detail::powerOfTwo(static_cast<int>(n) - half);
}

/// ln x; −infinity at 0, not a number below.
inline double log(double x) {
  if (!std::isgreater(x, 0.0)) {
    return x == 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  }
  if (x == std::numeric_limits<double>::infinity()) {
    return x;
  }
  int exponent = 0;
  if (x < std::numeric_limits<double>::min()) {
    x *= 0x1p54;
    exponent = -54;
  }
  // x = 2ⁿ·m with √½ ≤ m < √2: take the bits of √½ off before reading the exponent.
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t kSqrtHalf = 0x3fe6a09e667f3bcdU;
  const auto n = static_cast<std::int64_t>(bits - kSqrtHalf) >> 52;
  const auto m = std::bit_cast<double>(bits - (static_cast<std::uint64_t>(n) << 52U));
  exponent += static_cast<int>(n);
  // ln m = 2 artanh s with s = f/(2+f), f = m − 1 exact; and 2s = f − s f, so that f itself carries the
  // digits.
  const double f = m - 1;
  const double s = f / (2 + f);
  const double s2 = s * s;
  const double s4 = s2 * s2;
  const double s8 = s4 * s4;
  const double tail = s2 * (((2.0 / 3 + s2 * (2.0 / 5)) + s4 * (2.0 / 7 + s2 * (2.0 / 9))) +
                            s8 * (((2.0 / 11 + s2 * (2.0 / 13)) + s4 * (2.0 / 15 + s2 * (2.0 / 17))) +
                                  s8 * (2.0 / 19 + s2 * (2.0 / 21))));
  // ln m = f − f²/2 + s (f²/2 + tail).
  const double halfSquare = 0.5 * f * f;
  const double turns = exponent;
  return turns * 0x1.62e42fefa2p-1 +
         (f - (halfSquare - (s * (halfSquare + tail) + turns * 0x1.9ef35793c7673p-41)));
}

namespace detail {

/// atan(k/8) as hi + lo.
inline constexpr std::array<DoubleDouble, 9> kArcTangentOfEighths = {{
    {0x0.0p+0, 0x0.0p+0},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
}};

/// atan(y/x) for 0 ≤ y ≤ x, x > 0, as hi + lo: atan(k/8) + atan((y − x k/8)/(x + y k/8)). Not a number for
/// any others, which have no entry in the table.
inline DoubleDouble arcTangent(double y, double x) {
  const double rounding = 8 * (y / x) + 0.5;
  if (!(rounding >= 0 && rounding < 9)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const int k = static_cast<int>(rounding);
  const double c = 0.125 * k;
  const DoubleDouble cx = twoProduct(c, x);
  const DoubleDouble numerator = fastTwoSum(y - cx.hi, -cx.lo);
  const DoubleDouble denominator = DoubleDouble(x) + twoProduct(c, y);
  const DoubleDouble r = numerator / denominator;  // |r| ≤ 1/16
  const double r2 = r.hi * r.hi;
  const double r4 = r2 * r2;
  const double tail = ((-1.0 / 3 + r2 * (1.0 / 5)) + r4 * (-1.0 / 7 + r2 * (1.0 / 9))) +
                      r4 * r4 * (-1.0 / 11 + r2 * (1.0 / 13));
  const DoubleDouble& step = kArcTangentOfEighths[static_cast<std::size_t>(k)];
  const DoubleDouble sum = fastTwoSum(step.hi, r.hi);
  return fastTwoSum(sum.hi, sum.lo + (step.lo + (r.lo + r.hi * r2 * tail)));
}

}  // namespace detail

/// The angle [rad] from the x axis to (x, y), in [−π, π]; 0 for (0, 0). Not a number where both are infinite
/// or one is not a number.
inline double atan2(double y, double x) {
  const double ay = std::fabs(y);
  const double ax = std::fabs(x);
  if (ay == 0 && ax == 0) {
    return 0;
  }
  // The angle to the nearer axis, added to or taken off a multiple of π/2: by table, not by unpredictable
  // branches.
  constexpr std::array<DoubleDouble, 4> kStart = {{{0, 0},
                                                   {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54},
                                                   {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53},
                                                   {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54}}};
  constexpr std::array<double, 4> kDirection = {1, -1, -1, 1};
  const std::size_t octant = (ay > ax ? 1U : 0U) + (x < 0 ? 2U : 0U);
  const DoubleDouble angle = detail::arcTangent(ay < ax ? ay : ax, ay < ax ? ax : ay);
  const DoubleDouble turned =
      kStart[octant] + DoubleDouble(kDirection[octant] * angle.hi, kDirection[octant] * angle.lo);
  const auto rounded = static_cast<double>(turned);
  return y < 0 ? -rounded : rounded;
}

template <class Real>
Real pi() {
  if constexpr (std::is_floating_point_v<Real>) {
    return std::numbers::pi_v<Real>;
  } else {
    static const Real kPi = 4 * atan(Real(1));
    return kPi;
  }
}

template <class Real>
SinCos<Real> sinCos(const Real& x) {
  using std::cos;
  using std::sin;
  return {sin(x), cos(x)};
}

template <class Real>
Real nearestInteger(const Real& x) {
  using std::floor;
  return floor(x + Real(0.5));
}

template <class Real>
SinCos<Real> sinCosQuarterTurns(const Real& quarterTurns, const Real& rest) {
  const SinCos<Real> near = sinCos(rest);
  switch (toInteger<std::int64_t>(quarterTurns, std::int64_t{0}) & 3) {
    case 0:
      return near;
    case 1:
      return {near.cos, Real(-near.sin)};
    case 2:
      return {Real(-near.sin), Real(-near.cos)};
    default:
      return {Real(-near.cos), near.sin};
  }
}

template <class Real>
Real exp(const Real& x) {
  using std::exp;
  return exp(x);
}

template <class Real>
Real log(const Real& x) {
  using std::log;
  return log(x);
}

template <class Real>
Real atan2(const Real& y, const Real& x) {
  using std::atan2;
  return atan2(y, x);
}

}  // namespace careen::elementary
