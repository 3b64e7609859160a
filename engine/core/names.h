#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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

/// The places of named things in the order of their names; of equals, the first comes first.
template <class Named>
std::vector<std::size_t> orderByName(const Named& named) {
  std::vector<std::size_t> order(std::size(named));
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&named](std::size_t x, std::size_t y) { return named[x].name < named[y].name; });
  return order;
}

}  // namespace careen
