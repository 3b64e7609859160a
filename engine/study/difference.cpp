#include "study/difference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace careen {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

// ‖A − B‖ = 2√2 sin(θ/2), which keeps its digits where θ is small; near π the trace does.
double angleBetween(const Mat3& a, const Mat3& b) {
  const double sine = (a - b).norm() / (2 * std::numbers::sqrt2);
  if (sine < 0.5) {
    return 2 * std::asin(sine);
  }
  const double cosine = ((a.transpose() * b).trace() - 1) / 2;
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

std::vector<BodyState> withPoses(std::span<const Pose> poses) {
  std::vector<BodyState> states;
  for (const Pose& pose : poses) {
    states.push_back({.pose = pose});
  }
  return states;
}

PoseDifference differenceOf(const World& world, std::span<const BodyState> a, std::span<const BodyState> b) {
  PoseDifference worst;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    if (isImmovable(body.mass)) {
      continue;
    }
    const double position = (a[i].pose.position - b[i].pose.position).norm();
    const double angle = angleBetween(a[i].pose.worldFromBody, b[i].pose.worldFromBody);
    if (!std::isfinite(position + angle)) {  // a maximum would lose it
      return {kInfinity, kInfinity, kInfinity};
    }
    worst.position = std::max(worst.position, position);
    worst.angle = std::max(worst.angle, angle);
    worst.relative = std::max({worst.relative, position / body.halfExtents.norm(), angle});
  }
  return worst;
}

}  // namespace careen
