#include "audit/joint_gap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace careen {
namespace {

constexpr double kJointUlps = 256 * std::numeric_limits<double>::epsilon();

const Body* bodyAt(const World& world, const JointEnd& end) {
  return end.body ? &world.bodies[static_cast<std::size_t>(*end.body)] : nullptr;
}

// [1] The chord of the angle between directions of both ends, of the worst from this column on.
double misalignment(const Mat3& from, const Mat3& to, Eigen::Index first) {
  double worst = 0;
  for (Eigen::Index column = first; column < 3; ++column) {
    worst = std::max(worst, Vec3(from.col(column) - to.col(column)).norm());
  }
  return worst;
}

// [m] Of its points.
double distanceBeyond(const Joint& joint, const Vec3& apart, const Vec3& axis) {
  switch (joint.kind) {
    case Joint::Kind::kSlider:
      return Vec3(apart - apart.dot(axis) * axis).norm();
    case Joint::Kind::kRod:
      return std::fabs(apart.norm() - joint.length);
    case Joint::Kind::kRope:
      return std::max(apart.norm() - joint.length, 0.0);
    default:
      return apart.norm();
  }
}

}  // namespace

JointGap jointGapOf(const World& world, const Joint& joint, const Pose& from, const Pose& to) {
  const Mat3 fromAxes = joint.from.axesAt(from);
  const Mat3 toAxes = joint.to.axesAt(to);
  const Vec3 fromPoint = joint.from.pointAt(from);
  const Vec3 toPoint = joint.to.pointAt(to);
  double size = std::numeric_limits<double>::infinity();
  double reach = joint.length + fromPoint.norm() + toPoint.norm();
  for (const JointEnd* end : {&joint.from, &joint.to}) {
    if (const Body* const body = bodyAt(world, *end)) {
      size = std::min(size, body->halfExtents.norm());
      reach += end->point.norm() + body->halfExtents.norm();
    }
  }
  JointGap gap{.open = distanceBeyond(joint, fromPoint - toPoint, toAxes.col(2)),
               .rounding = kJointUlps * reach};
  if (joint.kind == Joint::Kind::kFixed || joint.kind == Joint::Kind::kSlider) {
    gap.open = std::max(gap.open, size * misalignment(fromAxes, toAxes, 0));
  } else if (joint.kind == Joint::Kind::kHinge) {
    gap.open = std::max(gap.open, size * misalignment(fromAxes, toAxes, 2));
  }
  if (joint.hasCoordinate()) {
    const double coordinate = jointCoordinate(joint, from, to);
    gap.beyond = (joint.kind == Joint::Kind::kHinge ? size : 1) *
                 std::max({coordinate - joint.highest, joint.lowest - coordinate, 0.0});
  }
  return gap;
}

}  // namespace careen
