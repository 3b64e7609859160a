#include "physics/contact/dips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace careen {
namespace {

/// [1] of the tolerance: bodies that are deeper than it in each other may go so much deeper in a step.
constexpr double kDeeper = 0x1p-4;
/// [1] of the tolerance: sampled gaps that differ by less are not searched between.
constexpr double kLower = 0x1p-6;
constexpr int kMostSearches = 12;

}  // namespace

// By golden sections.
double lowestBetween(double from, double to, const GapAt& valueAt) {
  constexpr double kGolden = 0.6180339887498949;
  double left = to - kGolden * (to - from);
  double right = from + kGolden * (to - from);
  double ofLeft = valueAt(left);
  double ofRight = valueAt(right);
  for (int k = 0; k < kMostSearches; ++k) {
    if (ofLeft < ofRight) {
      to = right;
      right = left;
      ofRight = ofLeft;
      left = to - kGolden * (to - from);
      ofLeft = valueAt(left);
    } else {
      from = left;
      left = right;
      ofLeft = ofRight;
      right = from + kGolden * (to - from);
      ofRight = valueAt(right);
    }
  }
  return ofLeft < ofRight ? left : right;
}

double lowestOfCubic(double h, double valueFrom, double rateFrom, double valueTo, double rateTo) {
  const double from = h * rateFrom;
  const double to = h * rateTo;
  const double rise = valueTo - valueFrom;
  const double b = 3 * rise - 2 * from - to;  // value = start + from s + b s² + c s³
  const double c = from + to - 2 * rise;
  const double squared = b * b - 3 * from * c;
  if (!(squared > 0)) {
    return 0;
  }
  const double root = std::sqrt(squared);
  const double above = b > 0 ? -from : root - b;
  const double below = b > 0 ? b + root : 3 * c;
  if (!(above > 0 && above < below)) {
    return 0;
  }
  const double s = above / below;
  return valueFrom + s * (from + s * (b + s * c)) < 0 ? s * h : 0;
}

double deepMoment(const GapAt& gapAt, double h, double tolerance) {
  constexpr std::size_t kMoments = 16;
  std::array<double, kMoments + 1> gaps{};
  const auto timeOf = [h](std::size_t k) { return h * static_cast<double>(k) / kMoments; };
  const auto deep = [&] { return std::min(-tolerance, gaps[0] - kDeeper * tolerance); };
  for (std::size_t k = 0; k <= kMoments; ++k) {
    gaps[k] = gapAt(timeOf(k));
    if (k > 0 && k < kMoments && gaps[k] < deep()) {
      return timeOf(k);
    }
  }
  for (std::size_t k = 0; k <= kMoments; ++k) {
    const std::size_t before = k > 0 ? k - 1 : k;
    const std::size_t after = k < kMoments ? k + 1 : k;
    const bool isLowest = gaps[k] <= gaps[before] && gaps[k] <= gaps[after] && gaps[k] < tolerance &&
                          gaps[k] < std::max(gaps[before], gaps[after]) - kLower * tolerance;
    if (isLowest) {
      const double lowest = lowestBetween(timeOf(before), timeOf(after), gapAt);
      if (gapAt(lowest) < deep()) {
        return lowest;
      }
    }
  }
  return 0;
}

}  // namespace careen
