#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "core/error.h"

namespace careen {

/// "one, two, three"
inline std::string listed(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) {
    text.append(text.empty() ? "" : ", ").append(name);
  }
  return text;
}

/// The index of a name in `names`; InputError, which lists them, if it is none of them.
inline std::size_t indexAmong(std::string_view name, std::span<const std::string_view> names) {
  for (std::size_t index = 0; index < names.size(); ++index) {
    if (names[index] == name) {
      return index;
    }
  }
  throw InputError("found '" + std::string(name) + "', expected one of: " + listed(names));
}

}  // namespace careen
