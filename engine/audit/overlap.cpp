#include "audit/overlap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace careen {
namespace {

AuditBox boxWith(const Vec3& halfExtents, const Vec3& center, const Pose& pose) {
  AuditBox box{halfExtents, pose};
  for (int axis = 0; axis < 3; ++axis) {
    if (center[axis] != 0) {
      box.pose.position += center[axis] * pose.worldFromBody.col(axis);
    }
  }
  return box;
}

// The least of several; NaN if one is.
double nearer(double least, double next) { return next < least || std::isnan(next) ? next : least; }

}  // namespace

double reachAlong(const AuditBox& box, const Vec3& direction) {
  return (box.pose.worldFromBody.transpose() * direction).cwiseAbs().dot(box.halfExtents);
}

std::vector<AuditBox> auditBoxes(const Body& body, const Pose& pose) {
  if (body.parts.empty()) {
    return {boxWith(body.halfExtents, body.boxCenter, pose)};
  }
  std::vector<AuditBox> boxes;
  for (const BodyPart& part : body.parts) {
    Pose own = pose;
    for (int axis = 0; axis < 3; ++axis) {
      own.worldFromBody.col(axis) = pose.worldFromBody * part.bodyFromPart.col(axis);
    }
    boxes.push_back(boxWith(part.halfExtents, part.center, own));
  }
  return boxes;
}

double separationOf(const AuditBox& a, const AuditBox& b) {
  const Vec3 between = b.pose.position - a.pose.position;
  double widest = -std::numeric_limits<double>::infinity();
  bool finite = between.allFinite();
  forEachAxis(a, b, [&](const Vec3& axis) {
    const double gap = std::fabs(between.dot(axis)) - reachAlong(a, axis) - reachAlong(b, axis);
    finite = finite && std::isfinite(gap);
    widest = std::max(widest, gap);
  });
  return finite ? widest : std::numeric_limits<double>::quiet_NaN();
}

double separationOf(const AuditBox& box, const WallPlane& wall) {
  return wall.normal.dot(box.pose.position) - wall.offset - reachAlong(box, wall.normal);
}

double separationOf(const Body& a, const Pose& poseA, const Body& b, const Pose& poseB) {
  double least = std::numeric_limits<double>::infinity();
  const std::vector<AuditBox> others = auditBoxes(b, poseB);
  for (const AuditBox& box : auditBoxes(a, poseA)) {
    for (const AuditBox& other : others) {
      least = nearer(least, separationOf(box, other));
    }
  }
  return least;
}

double separationOf(const Body& body, const Pose& pose, const WallPlane& wall) {
  double least = std::numeric_limits<double>::infinity();
  for (const AuditBox& box : auditBoxes(body, pose)) {
    least = nearer(least, separationOf(box, wall));
  }
  return least;
}

}  // namespace careen
