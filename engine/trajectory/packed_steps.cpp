#include "trajectory/packed_steps.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <variant>

namespace careen {
namespace {

constexpr int kDigits = 53;            // of a double
constexpr double kLargest = 0x1p+52;   // [1] of integers
constexpr int kExponentBits = 12;      // of the power of two,
constexpr int kLeastExponent = -2048;  // from this one on
constexpr int kWidthBits = 6;          // of how many bits numbers have
constexpr std::size_t kPerPower = 7;   // numbers: a place and a quaternion
constexpr std::size_t kPlaces = 3;     // of them

// work(number, its index), in order of powers.
template <class Step, class Work>
void forEachNumber(Step& step, const Work& work) {
  std::size_t index = 0;
  for (std::size_t power = 0; power < step.position.size(); ++power) {
    for (auto& number : step.position[power]) {
      work(number, index++);
    }
    for (auto& number : step.worldFromBody[power]) {
      work(number, index++);
    }
  }
}

// work(first, last) for numbers of one width.
template <class Work>
void forEachGroup(const Work& work) {
  for (std::size_t first = 0; first < StepCoder::kNumbers; first += kPerPower) {
    work(first, first + kPlaces);
    work(first + kPlaces, first + kPerPower);
  }
}

// As std::ldexp, which is a call: of the time that unpacking took, half.
double timesPower(double number, int exponent) {
  constexpr int kLeast = -1022;
  if (exponent < kLeast || exponent > -kLeast) {
    return std::ldexp(number, exponent);
  }
  return number * std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52U);
}

// Exponent of the lowest bit that is set; of 0 there is none.
std::optional<int> lowestBit(double number) {
  int exponent = 0;
  const double mantissa = std::frexp(number, &exponent);
  if (number == 0 || !std::isfinite(number)) {
    return std::nullopt;
  }
  const auto digits = static_cast<std::uint64_t>(std::ldexp(std::fabs(mantissa), kDigits));
  return exponent - kDigits + std::countr_zero(digits);
}

// That most steps share: a step whose numbers are rounded to a grid has one odd multiple at least, almost
// surely.
int exponentOf(const Segments& segments) {
  std::map<int, std::size_t> steps;
  for (const Segment& segment : segments) {
    if (const CrowdStep* const step = std::get_if<CrowdStep>(&segment.motion)) {
      std::optional<int> lowest;
      forEachNumber(*step, [&](double number, std::size_t /*index*/) {
        const std::optional<int> own = lowestBit(number);
        lowest = own && lowest ? std::min(*own, *lowest) : own ? own : lowest;
      });
      ++steps[lowest.value_or(0)];
    }
  }
  const auto most = std::max_element(steps.begin(), steps.end(),
                                     [](const auto& x, const auto& y) { return x.second < y.second; });
  return most == steps.end() ? 0 : most->first;
}

// 0, −1, 1, −2, 2 …: small numbers have few bits.
std::uint64_t folded(std::int64_t number) {
  return (static_cast<std::uint64_t>(number) << 1U) ^ (number < 0 ? ~std::uint64_t{0} : 0);
}
std::int64_t unfolded(std::uint64_t number) {
  return static_cast<std::int64_t>((number >> 1U) ^ ((number & 1U) != 0 ? ~std::uint64_t{0} : 0));
}

bool isNegativeZero(double number) { return number == 0 && std::signbit(number); }

}  // namespace

// It begins where the last one ended, with the velocities there.
StepCoder::Numbers StepCoder::expected(double duration) const {
  Numbers numbers = {};
  const double ratio = duration / duration_;
  for (std::size_t i = 0; i < kPerPower && duration_ > 0; ++i) {
    const std::int64_t first = numbers_[i + kPerPower];
    const std::int64_t second = numbers_[i + 2 * kPerPower];
    const std::int64_t third = numbers_[i + 3 * kPerPower];
    numbers[i] = numbers_[i] + first + second + third;
    const double slope = std::rint(static_cast<double>(first + 2 * second + 3 * third) * ratio);
    numbers[i + kPerPower] = std::fabs(slope) <= kLargest ? static_cast<std::int64_t>(slope) : 0;
  }
  return numbers;
}

void StepCoder::follow(double start, double duration, const Numbers& numbers) {
  end_ = start + duration;
  duration_ = duration;
  numbers_ = numbers;
}

// ---- Packing.

StepPacker::StepPacker(const Segments& segments) : StepCoder(exponentOf(segments)) {
  bits_.put(static_cast<std::uint64_t>(exponent_ - kLeastExponent), kExponentBits);
}

std::optional<StepCoder::Numbers> StepPacker::numbersOf(const CrowdStep& step) const {
  Numbers numbers = {};
  bool fit = true;
  forEachNumber(step, [&](double number, std::size_t index) {
    const double multiple = timesPower(number, -exponent_);
    fit = fit && std::fabs(multiple) <= kLargest && timesPower(std::rint(multiple), exponent_) == number;
    numbers[index] = fit ? static_cast<std::int64_t>(multiple) : 0;
  });
  return fit ? std::optional(numbers) : std::nullopt;
}

bool StepPacker::add(const Segment& segment) {
  const CrowdStep* const step = std::get_if<CrowdStep>(&segment.motion);
  const std::optional<Numbers> numbers = step != nullptr ? numbersOf(*step) : std::nullopt;
  bits_.put(numbers ? 1 : 0, 1);
  if (!numbers) {
    return false;
  }
  const bool goesOn = std::bit_cast<std::uint64_t>(segment.start) == std::bit_cast<std::uint64_t>(end_);
  bits_.put(goesOn ? 1 : 0, 1);
  if (!goesOn) {
    times_.visit(segment.start);
  }
  times_.visit(step->duration);
  const Numbers known = expected(step->duration);
  forEachGroup([&](std::size_t first, std::size_t last) {
    std::uint64_t all = 0;
    for (std::size_t i = first; i < last; ++i) {
      all |= folded((*numbers)[i] - known[i]);
    }
    const auto width = static_cast<int>(std::bit_width(all));
    bits_.put(static_cast<std::uint64_t>(width), kWidthBits);
    for (std::size_t i = first; i < last; ++i) {
      bits_.put(folded((*numbers)[i] - known[i]), width);
    }
  });
  bool any = false;
  forEachNumber(*step, [&](double number, std::size_t /*index*/) { any = any || isNegativeZero(number); });
  bits_.put(any ? 1 : 0, 1);
  forEachNumber(*step, [&](double number, std::size_t /*index*/) {
    bits_.put(isNegativeZero(number) ? 1 : 0, any ? 1 : 0);
  });
  follow(segment.start, step->duration, *numbers);
  return true;
}

// ---- Unpacking.

StepUnpacker::StepUnpacker(std::string_view times, std::string_view bits)
    : StepCoder(0), times_(times), bits_(bits) {
  exponent_ = static_cast<int>(bits_.get(kExponentBits)) + kLeastExponent;
}

double StepUnpacker::time() {
  double value = 0;
  ArchiveReader(times_, {}).visit(value);
  times_.remove_prefix(sizeof(double));
  return value;
}

StepUnpacker::Next StepUnpacker::next(Segment& segment) {
  if (bits_.get(1) == 0) {
    return bits_.isBeyond() ? Next::kDamaged : Next::kAsItIs;
  }
  const bool goesOn = bits_.get(1) != 0;
  if (times_.size() < (goesOn ? 1 : 2) * sizeof(double)) {
    return Next::kDamaged;
  }
  segment.start = goesOn ? end_ : time();
  CrowdStep& step = segment.motion.emplace<CrowdStep>();
  step.duration = time();
  Numbers numbers = expected(step.duration);
  bool fit = true;
  forEachGroup([&](std::size_t first, std::size_t last) {
    const int width = static_cast<int>(bits_.get(kWidthBits));
    for (std::size_t i = first; i < last; ++i) {
      numbers[i] += unfolded(bits_.get(width));
      fit = fit && std::fabs(static_cast<double>(numbers[i])) <= kLargest;
    }
  });
  forEachNumber(step, [&](double& number, std::size_t index) {
    number = timesPower(static_cast<double>(numbers[index]), exponent_);
  });
  const int signs = static_cast<int>(bits_.get(1));
  forEachNumber(step, [&](double& number, std::size_t /*index*/) {
    number = bits_.get(signs) != 0 ? -number : number;
  });
  follow(segment.start, step.duration, numbers);
  return fit && !bits_.isBeyond() ? Next::kPacked : Next::kDamaged;
}

}  // namespace careen
