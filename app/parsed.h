#pragma once

#include <limits>
#include <string>

#include "core/error.h"

namespace careen {

/// Parses, or checks, an option's value; an InputError of `parse` is prefixed with the option.
template <class Value, class Parse>
auto parsed(const char* option, const Value& value, Parse parse) {
  try {
    return parse(value);
  } catch (const InputError& error) {
    throw InputError(std::string(option) + ": " + error.what());
  }
}

/// The number that all of an option's text is, from `least` to `most`; InputError says what is expected.
double numberIn(const char* option, const std::string& text, const std::string& expected, double least,
                double most = std::numeric_limits<double>::max());
/// The least positive number, where 0 is not one.
inline constexpr double kAboveZero = std::numeric_limits<double>::denorm_min();

}  // namespace careen
