#include "physics/search/concave_bound.h"

#include <algorithm>
#include <cmath>

namespace careen {

double firstRoot(double height, double rate, double fall, double none) {
  const double discriminant = rate * rate + 2 * fall * height;
  if (discriminant < 0) {
    return none;
  }
  const double root = std::sqrt(discriminant);
  if (rate < 0) {
    return 2 * height / (root - rate);
  }
  return fall > 0 ? (rate + root) / fall : none;
}

double ConcaveBound::value() const {
  return level_ - sum([](const Kink& kink) { return kink.weight * std::fabs(kink.value); });
}

double ConcaveBound::rateAhead(double tie) const {
  return rate_ - sum([tie](const Kink& kink) {
           if (2 * kink.weight * std::fabs(kink.value) <= tie) {
             return kink.weight * std::fabs(kink.rate);
           }
           return kink.value > 0 ? kink.weight * kink.rate : -kink.weight * kink.rate;
         });
}

double ConcaveBound::vertexRoot(double floor, double at, double most) const {
  const auto positive = [at](const Kink& kink) {
    const double ahead = kink.value + kink.rate * at;
    return ahead > 0 || (ahead == 0 && kink.rate > 0);
  };
  const double height = level_ - floor - sum([&](const Kink& kink) {
                          return positive(kink) ? kink.weight * kink.value : -kink.weight * kink.value;
                        });
  const double rate = rate_ - sum([&](const Kink& kink) {
                        return positive(kink) ? kink.weight * kink.rate : -kink.weight * kink.rate;
                      });
  // Only rounding can put a vertex at or below the floor.
  return height > 0 ? firstRoot(height, rate, curvature_, most) : 0;
}

double ConcaveBound::firstReach(double floor, double most) const {
  double reach = std::min(vertexRoot(floor, 0, most), most);
  while (reach > 0) {
    const double lower = vertexRoot(floor, reach, most);
    if (lower >= reach) {
      break;
    }
    reach = lower;
  }
  return reach;
}

}  // namespace careen
