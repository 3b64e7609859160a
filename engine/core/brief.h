#pragma once

#include <array>
#include <charconv>
#include <string>

namespace careen {

/// A number as messages give it, with so many significant digits: "0.08211". No locale has a say.
inline std::string brief(double value, int significant = 4) {
  std::array<char, 32> digits{};
  char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                  std::chars_format::general, significant)
                        .ptr;
  return {digits.data(), end};
}

/// As few digits as bring the same number back: two that differ do not look the same.
inline std::string inFull(double value) {
  std::array<char, 32> digits{};
  char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return {digits.data(), end};
}

}  // namespace careen
