#pragma once

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

}  // namespace careen
