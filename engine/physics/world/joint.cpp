#include "physics/world/joint.h"

#include <cmath>

#include "core/math/elementary.h"

namespace careen {

double jointCoordinate(const Joint& joint, const Pose& from, const Pose& to) {
  const Mat3 axes = joint.to.axesAt(to);
  if (joint.kind == Joint::Kind::kSlider) {
    return dot(axes.col(2), Vec3(joint.from.pointAt(from) - joint.to.pointAt(to)));
  }
  const Vec3 x = joint.from.axesAt(from).col(0);
  const double angle = elementary::atan2(dot(x, axes.col(1)), dot(x, axes.col(0)));
  const bool isLimited = std::isfinite(joint.lowest) && std::isfinite(joint.highest);
  const double middle = isLimited ? 0.5 * (joint.lowest + joint.highest) : joint.rest;
  constexpr double kTurn = 2 * 3.141592653589793;
  return angle > middle + 0.5 * kTurn ? angle - kTurn : angle <= middle - 0.5 * kTurn ? angle + kTurn : angle;
}

}  // namespace careen
