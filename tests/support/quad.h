#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

#include "core/math/double_double.h"

namespace careen {

/// Quadruple precision (113 bits, about 34 digits) without compiler extensions.
using Quad = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<113, boost::multiprecision::digit_base_2, void, boost::int16_t,
                                         -16382, 16383>,
    boost::multiprecision::et_off>;

/// acos(−1), by its first 159 bits: to compute it, each test file would compile all of Boost's power series.
inline Quad quadPi() {
  return Quad(0x1.921fb54442d18p+1) + Quad(0x1.1a62633145c07p-53) + Quad(-0x1.f1976b7ed8fbcp-109);
}

inline Quad quadOf(const DoubleDouble& x) { return Quad(x.hi) + Quad(x.lo); }

/// 192 bits: for motions that amplify even the rounding errors of a Quad.
using Bits192 = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<192, boost::multiprecision::digit_base_2, void, boost::int32_t>,
    boost::multiprecision::et_off>;

}  // namespace careen
