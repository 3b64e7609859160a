#include "physics/geometry/normal_cone.h"

#include <cmath>

#include "core/math/double_double.h"

namespace careen {
namespace {

using Wide3 = std::array<DoubleDouble, 3>;

// Squared length below which a direction is rounding error.
constexpr double kNoDirection = 0x1p-80;

Wide3 sum(const Wide3& a, const Wide3& b) {
  Wide3 result;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = normalized(a[k] + b[k]);
  }
  return result;
}

Wide3 cross(const Vec3& a, const Vec3& b) {
  return {twoProduct(a.y(), b.z()) - twoProduct(a.z(), b.y()),
          twoProduct(a.z(), b.x()) - twoProduct(a.x(), b.z()),
          twoProduct(a.x(), b.y()) - twoProduct(a.y(), b.x())};
}

DoubleDouble wideDot(const Wide3& a, const Vec3& b) {
  return normalized(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

bool less(const DoubleDouble& a, const DoubleDouble& b) {
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}

}  // namespace

// The smallest round cone around the bounds has the same axis, and two or three bounds determine it: every
// pair's and triple's axis is tried.
NormalCone::Centre NormalCone::centre() const {
  Centre best;
  DoubleDouble most = -1;
  const auto consider = [&](const Wide3& along) {
    const DoubleDouble squared = square(along[0]) + square(along[1]) + square(along[2]);
    if (!(squared.hi > kNoDirection)) {
      return;
    }
    const DoubleDouble length = normalized(sqrt(normalized(squared)));
    const double turn = wideDot(along, bounds_[0]).hi < 0 ? -1 : 1;
    Wide3 direction;
    for (std::size_t k = 0; k < 3; ++k) {
      direction[k] = normalized(turn * along[k] / length);
    }
    DoubleDouble margin = wideDot(direction, bounds_[0]);
    for (std::size_t k = 1; k < count_; ++k) {
      const DoubleDouble other = wideDot(direction, bounds_[k]);
      margin = less(other, margin) ? other : margin;
    }
    if (less(most, margin)) {
      most = margin;
      best.direction = Vec3(static_cast<double>(direction[0]), static_cast<double>(direction[1]),
                            static_cast<double>(direction[2]));
      best.margin = static_cast<double>(margin);
    }
  };
  for (std::size_t i = 0; i < count_; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3& p = bounds_[i];
      const Vec3& q = bounds_[j];
      consider({twoSum(p.x(), q.x()), twoSum(p.y(), q.y()), twoSum(p.z(), q.z())});
      for (std::size_t k = 0; k < j; ++k) {  // equal angles to all three
        const Vec3& r = bounds_[k];
        consider(sum(sum(cross(p, q), cross(q, r)), cross(r, p)));
      }
    }
  }
  return best;
}

}  // namespace careen
