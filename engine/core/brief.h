#pragma once

#include <array>
#include <charconv>
#include <string>

namespace careen {

/// A number as messages show it, with that many significant digits: "0.08211". Independent of the locale.
inline std::string brief(double value, int significant = 4) {
  std::array<char, 32> digits{};
  char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                  std::chars_format::general, significant)
                        .ptr;
  return {digits.data(), end};
}

/// The shortest text that converts back to the same number, so different numbers look different.
inline std::string inFull(double value) {
  std::array<char, 32> digits{};
  char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return {digits.data(), end};
}

}  // namespace careen
