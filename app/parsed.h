#pragma once

#include <string>

#include "core/error.h"

namespace careen {

/// Parses an option's text; an InputError of `parse` is prefixed with the option.
template <class Parse>
auto parsed(const char* option, const std::string& text, Parse parse) {
  try {
    return parse(text);
  } catch (const InputError& error) {
    throw InputError(std::string(option) + ": " + error.what());
  }
}

}  // namespace careen
