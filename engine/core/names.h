#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "core/error.h"

namespace careen {

/// The place of a name among those there are; InputError, which lists them, if it is none of them.
inline std::size_t placeAmong(std::string_view name, std::span<const std::string_view> names) {
  std::string known;
  for (std::size_t place = 0; place < names.size(); ++place) {
    if (names[place] == name) {
      return place;
    }
    known.append(known.empty() ? "" : ", ").append(names[place]);
  }
  throw InputError("found '" + std::string(name) + "', expected one of: " + known);
}

}  // namespace careen
