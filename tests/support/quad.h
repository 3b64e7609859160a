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

inline const Quad kQuadPi = acos(Quad(-1));

inline Quad quadOf(const DoubleDouble& x) { return Quad(x.hi) + Quad(x.lo); }

/// 192 bits: for motions that amplify even the rounding errors of a Quad.
using Bits192 = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<192, boost::multiprecision::digit_base_2, void, boost::int32_t>,
    boost::multiprecision::et_off>;

}  // namespace careen
