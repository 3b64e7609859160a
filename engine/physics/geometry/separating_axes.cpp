#include "physics/geometry/separating_axes.h"

#include <algorithm>
#include <limits>

namespace careen {
namespace {

// Directions count as different if their angle moves the thinner box by this many times what counts as none.
constexpr double kDifferentDirections = 8;
// [1] In steps, where more than rounding counts as none, axes nearer to each other agree far from any edge.
constexpr double kAcross = 0.25;
// [1] Normals that differ by less are one direction.
constexpr double kOneDirection = 0x1p-4;

}  // namespace

AxisSet separatingAxes(const BoxAt& a, const BoxAt& b, const BoxAxes& axes, double within) {
  const double thinnest = std::min(a.halfExtents.minCoeff(), b.halfExtents.minCoeff());
  const double different =
      std::max(kDifferentDirections * within / thinnest, within > touchingWithin(a, b) ? kAcross : 0);
  const double least = std::min(axes.gap(), 0.0) - within;
  const Vec3 best = axes.normal(axes.best());
  AxisSet set = 0;
  bool differ = false;
  for (int k = 0; k < BoxAxis::kCount; ++k) {
    if (axes.separation({k}) >= least) {
      set |= 1U << k;
      differ = differ || (axes.normal({k}) - best).squaredNorm() > different * different;
    }
  }
  return differ ? set : 0;
}

AxisSet separatingAxes(const BoxAt& a, const BoxAt& b, double within) {
  return separatingAxes(a, b, BoxAxes(a, b), within);
}

AxisSet swapped(AxisSet set) {
  AxisSet other = 0;
  for (int k = 0; k < BoxAxis::kCount; ++k) {
    if (contains(set, k)) {
      const BoxAxis axis{k};
      other |= 1U << (k < 6 ? (k + 3) % 6 : 6 + 3 * axis.edgeOfB() + axis.edgeOfA());
    }
  }
  return other;
}

AxisSet withoutApproached(AxisSet set, const BoxAt& a, const BoxAt& b, const Vec3& velocity, double slow) {
  const BoxAxes axes(a, b);
  AxisSet open = 0;
  Vec3 first = Vec3::Zero();
  for (int k = 0; k < BoxAxis::kCount; ++k) {
    if (!contains(set, k) || dot(axes.normal({k}), velocity) < -slow) {
      continue;
    }
    const Vec3 normal = axes.normal({k});
    if (open != 0 && (normal - first).squaredNorm() > kOneDirection * kOneDirection) {
      return set;
    }
    first = open == 0 ? normal : first;
    open |= 1U << k;
  }
  return open != 0 ? open : set;
}

std::vector<Vec3> directionsOf(AxisSet set, const BoxAt& a, const BoxAt& b) {
  std::vector<Vec3> directions;
  if (set == 0) {
    return directions;
  }
  const BoxAxes axes(a, b);
  for (int k = 0; k < BoxAxis::kCount; ++k) {
    if (contains(set, k) && axes.separation({k}) > std::numeric_limits<double>::lowest()) {
      directions.push_back(axes.normal({k}));
    }
  }
  return directions;
}

double partingSpeed(std::span<const Vec3> directions, const Vec3& velocity) {
  double fastest = std::numeric_limits<double>::lowest();
  for (const Vec3& direction : directions) {
    fastest = std::max(fastest, dot(direction, velocity));
  }
  return fastest;
}

}  // namespace careen
