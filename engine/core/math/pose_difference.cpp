#include "core/math/pose_difference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace careen {

// ‖A − B‖ = 2√2 sin(θ/2) is accurate for small θ; the trace is accurate near π.
double angleBetween(const Mat3& a, const Mat3& b) {
  const double sine = (a - b).norm() / (2 * std::numbers::sqrt2);
  if (sine < 0.5) {
    return 2 * std::asin(sine);
  }
  const double cosine = ((a.transpose() * b).trace() - 1) / 2;
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

PoseDifference differenceOf(const Pose& a, const Pose& b, double halfDiagonal) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double position = (a.position - b.position).norm();
  const double angle = angleBetween(a.worldFromBody, b.worldFromBody);
  if (!std::isfinite(position + angle)) {  // std::max would lose it
    return {kInfinity, kInfinity, kInfinity};
  }
  return {position, angle, std::max(position / halfDiagonal, angle)};
}

void PoseDifference::include(const PoseDifference& other) {
  position = std::max(position, other.position);
  angle = std::max(angle, other.angle);
  relative = std::max(relative, other.relative);
}

}  // namespace careen
