#pragma once

#include <string>

#include "core/error.h"

namespace careen {

/// What `parse` makes of an option's text; its error names the option.
template <class Parse>
auto parsed(const char* option, const std::string& text, Parse parse) {
  try {
    return parse(text);
  } catch (const InputError& error) {
    throw InputError(std::string(option) + ": " + error.what());
  }
}

}  // namespace careen
