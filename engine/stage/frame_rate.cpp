#include "stage/frame_rate.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <optional>
#include <system_error>

#include "core/brief.h"
#include "core/error.h"

namespace careen {
namespace {

constexpr std::int64_t kMillion = 1'000'000;

// 24, 30, 60 and 120 slowed by 1000/1001, a legacy of colour television. Their usual spellings (23.976 …)
// differ from them by a relative 1e-6.
constexpr std::array<std::int64_t, 4> kBroadcast = {24, 30, 60, 120};
constexpr double kBroadcastTolerance = 2e-6;

[[noreturn]] void fail(std::string_view found) {
  throw InputError(
      "found " + std::string(found) +
      " frames per second, expected a rate from 0.001 to 100000, such as 30, 12.5 or 24000/1001");
}

FrameRate lowestTerms(std::int64_t numerator, std::int64_t denominator) {
  const std::int64_t divisor = std::gcd(numerator, denominator);
  return {.numerator = numerator / divisor, .denominator = denominator / divisor};
}

template <class Number>
std::optional<Number> wholeText(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

std::optional<FrameRate> ratio(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) {
    return std::nullopt;
  }
  const std::optional<std::int64_t> numerator = wholeText<std::int64_t>(text.substr(0, slash));
  const std::optional<std::int64_t> denominator = wholeText<std::int64_t>(text.substr(slash + 1));
  if (!numerator || !denominator || *numerator <= 0 || *denominator <= 0) {
    return std::nullopt;
  }
  return lowestTerms(*numerator, *denominator);
}

bool inRange(double framesPerSecond) {
  return framesPerSecond >= kSlowestFrameRate && framesPerSecond <= kFastestFrameRate;
}

}  // namespace

double FrameRate::frameTime(std::int64_t frame) const {
  // Products stay below 2⁵³ (10⁹ frames times 10⁶), so neither conversion rounds.
  return static_cast<double>(frame * denominator) / static_cast<double>(numerator);
}

std::int64_t FrameRate::frameCount(double duration) const {
  if (!(duration > 0)) {
    return 0;
  }
  const double about =
      std::ceil(duration * static_cast<double>(numerator) / static_cast<double>(denominator));
  if (!(about <= static_cast<double>(kMostFrames))) {
    throw InputError("found a film longer than " + std::to_string(kMostFrames) +
                     " frames, expected a shorter duration or fewer frames per second");
  }
  // `about` was rounded twice; the frame times decide.
  auto count = static_cast<std::int64_t>(about);
  while (count > 0 && frameTime(count - 1) >= duration) {
    --count;
  }
  while (frameTime(count) < duration) {
    ++count;
  }
  return count;
}

std::string FrameRate::text() const {
  return denominator == 1 ? std::to_string(numerator)
                          : std::to_string(numerator) + "/" + std::to_string(denominator);
}

FrameRate frameRateFrom(double framesPerSecond) {
  if (!inRange(framesPerSecond)) {
    fail(inFull(framesPerSecond));
  }
  for (const std::int64_t rate : kBroadcast) {
    const double exact = static_cast<double>(rate * 1000) / 1001;
    if (std::fabs(framesPerSecond - exact) <= kBroadcastTolerance * exact) {
      return {.numerator = rate * 1000, .denominator = 1001};
    }
  }
  return lowestTerms(std::llround(framesPerSecond * static_cast<double>(kMillion)), kMillion);
}

FrameRate parseFrameRate(std::string_view text) {
  if (const std::optional<FrameRate> rate = ratio(text)) {
    if (rate->denominator > kMillion ||
        !inRange(static_cast<double>(rate->numerator) / static_cast<double>(rate->denominator))) {
      fail(text);
    }
    return *rate;
  }
  const std::optional<double> decimal = wholeText<double>(text);
  if (!decimal || !inRange(*decimal)) {
    fail("'" + std::string(text) + "'");
  }
  return frameRateFrom(*decimal);
}

}  // namespace careen
