#include "physics/world/joint.h"

#include <cmath>

#include "core/math/elementary.h"

namespace careen {
namespace {

constexpr double kTurnOfHinge = 2 * 3.141592653589793;

}  // namespace

double jointCoordinate(const Joint& joint, const Pose& from, const Pose& to) {
  const Mat3 axes = joint.to.axesAt(to);
  if (joint.kind == Joint::Kind::kSlider) {
    return dot(axes.col(2), Vec3(joint.from.pointAt(from) - joint.to.pointAt(to)));
  }
  const Vec3 x = joint.from.axesAt(from).col(0);
  const double angle = elementary::atan2(dot(x, axes.col(1)), dot(x, axes.col(0)));
  const bool isLimited = std::isfinite(joint.lowest) && std::isfinite(joint.highest);
  const double middle = isLimited ? 0.5 * (joint.lowest + joint.highest) : joint.rest;
  return angle > middle + 0.5 * kTurnOfHinge    ? angle - kTurnOfHinge
         : angle <= middle - 0.5 * kTurnOfHinge ? angle + kTurnOfHinge
                                                : angle;
}

double inNearestTurn(const Joint& joint, double coordinate, double other) {
  return joint.kind == Joint::Kind::kHinge
             ? coordinate + kTurnOfHinge * std::rint((other - coordinate) / kTurnOfHinge)
             : coordinate;
}

}  // namespace careen
