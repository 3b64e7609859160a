#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

namespace careen {

/// Quadruple precision (113 bits, about 34 digits) without compiler extensions.
using Quad = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<113, boost::multiprecision::digit_base_2, void, boost::int16_t,
                                         -16382, 16383>,
    boost::multiprecision::et_off>;

/// 192 bits: for motions that amplify even the rounding errors of a Quad.
using Bits192 = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<192, boost::multiprecision::digit_base_2, void, boost::int32_t>,
    boost::multiprecision::et_off>;

}  // namespace careen
