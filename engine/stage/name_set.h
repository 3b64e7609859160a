#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/names.h"

namespace careen {

/// A set of named things: of the values of `Enum`, whose names `kNames` lists in their order.
template <class Enum, const auto& kNames>
class NameSet {
 public:
  static NameSet all() {
    NameSet set;
    set.has_.fill(true);
    return set;
  }

  void add(Enum value) { has_.at(static_cast<std::size_t>(value)) = true; }
  void remove(Enum value) { has_.at(static_cast<std::size_t>(value)) = false; }
  bool has(Enum value) const { return has_.at(static_cast<std::size_t>(value)); }
  bool any() const {
    return std::any_of(has_.begin(), has_.end(), [](bool has) { return has; });
  }

  /// Names separated by commas; "none" if empty.
  std::string text() const {
    std::string text;
    for (std::size_t i = 0; i < has_.size(); ++i) {
      if (has_[i]) {
        text.append(text.empty() ? "" : ",").append(kNames.at(i));
      }
    }
    return text.empty() ? "none" : text;
  }

  /// Parses what text() writes, names in any order. InputError for an unknown name; it lists the known ones.
  static NameSet named(std::string_view text) {
    NameSet set;
    if (text == "none") {
      return set;
    }
    for (std::size_t start = 0; start <= text.size();) {
      const std::size_t end = std::min(text.find(',', start), text.size());
      const std::string_view name = text.substr(start, end - start);
      const auto at = std::find(kNames.begin(), kNames.end(), name);
      if (at == kNames.end()) {
        throw InputError("found '" + std::string(name) + "', expected one or more of: none, " +
                         listed(kNames));
      }
      set.add(static_cast<Enum>(at - kNames.begin()));
      start = end + 1;
    }
    return set;
  }

  friend bool operator==(const NameSet&, const NameSet&) = default;

 private:
  std::array<bool, kNames.size()> has_{};
};

}  // namespace careen
