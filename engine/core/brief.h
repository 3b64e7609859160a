#pragma once

#include <array>
#include <charconv>
#include <string>

namespace careen {

/// A number as messages give it: four digits, "0.08211".
inline std::string brief(double value) {
  std::array<char, 32> digits{};
  char* const end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, 4).ptr;
  return {digits.data(), end};
}

}  // namespace careen
