#include "render/film/strobe.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "core/error.h"

namespace careen {
namespace {

constexpr double kMostMoments = 1000;

[[noreturn]] void fail(std::string_view text) {
  throw InputError("found '" + std::string(text) +
                   "', expected FROM:TO:STEP [s] such as 0:2:0.1, of a thousand moments at most");
}

}  // namespace

std::vector<double> parseStrobe(std::string_view text) {
  std::array<double, 3> numbers{};  // from, to, step
  std::string_view rest = text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t colon = rest.find(':');
    const std::string_view number = rest.substr(0, colon);
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), numbers[i]);
    const bool isLast = i + 1 == numbers.size();
    if (error != std::errc() || end != number.data() + number.size() ||
        (colon == std::string_view::npos) != isLast) {
      fail(text);
    }
    rest = isLast ? "" : rest.substr(colon + 1);
  }
  const auto [from, to, step] = numbers;
  const double steps = std::floor((to - from) / step * (1 + 1e-12) + 1e-9);
  if (!(from >= 0 && to >= from && step > 0 && steps < kMostMoments)) {
    fail(text);
  }
  std::vector<double> moments;
  for (int k = 0; k <= static_cast<int>(steps); ++k) {
    moments.push_back(std::fmin(to, from + k * step));
  }
  return moments;
}

}  // namespace careen
