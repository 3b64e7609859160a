#include "core/number_range.h"

#include <charconv>
#include <cmath>
#include <string>

#include "core/error.h"

namespace careen {
namespace {

[[noreturn]] void fail(std::string_view text) {
  throw InputError("found '" + std::string(text) + "', expected a number, or FROM:TO:STEP such as 0:2:0.1, " +
                   std::to_string(kMostInRange) + " numbers at most");
}

}  // namespace

std::vector<double> numbersOfRange(std::string_view text) {
  std::vector<double> parts;
  for (std::size_t at = 0; at <= text.size() && parts.size() <= 3;) {
    const std::string_view part = text.substr(at, text.find(':', at) - at);
    double number = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
    if (error != std::errc() || end != part.data() + part.size() || !std::isfinite(number) || number < 0) {
      fail(text);
    }
    parts.push_back(number);
    at += part.size() + 1;
  }
  if (parts.size() == 1) {
    return parts;
  }
  if (parts.size() != 3 || parts[1] < parts[0] || parts[2] <= 0 ||
      parts[1] - parts[0] >= (kMostInRange - 0.5) * parts[2]) {
    fail(text);
  }
  const double steps = std::floor((parts[1] - parts[0]) / parts[2] * (1 + 1e-12) + 1e-9);
  std::vector<double> numbers;
  for (int k = 0; k <= static_cast<int>(steps); ++k) {
    numbers.push_back(std::fmin(parts[1], parts[0] + k * parts[2]));
  }
  return numbers;
}

}  // namespace careen
