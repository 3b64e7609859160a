#include "audit/moments.h"

#include <algorithm>
#include <cmath>

namespace careen {

std::vector<double> goldenMoments(double duration, std::size_t count) {
  constexpr double kGolden = 0.61803398874989484820;  // (√5 − 1)/2
  std::vector<double> moments = {0, duration};
  moments.reserve(count + 2);
  for (std::size_t i = 1; i <= count; ++i) {
    const double turns = static_cast<double>(i) * kGolden;
    moments.push_back((turns - std::floor(turns)) * duration);
  }
  std::sort(moments.begin(), moments.end());
  return moments;
}

}  // namespace careen
