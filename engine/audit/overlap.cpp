#include "audit/overlap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace careen {
double reachAlong(const AuditBox& box, const Vec3& direction) {
  return (box.pose.worldFromBody.transpose() * direction).cwiseAbs().dot(box.halfExtents);
}

AuditBox auditBox(const Body& body, const Pose& pose) {
  AuditBox box{body.halfExtents, pose};
  for (int axis = 0; axis < 3; ++axis) {
    if (body.boxCenter[axis] != 0) {
      box.pose.position += body.boxCenter[axis] * pose.worldFromBody.col(axis);
    }
  }
  return box;
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

double separationOf(const AuditBox& box, const Wall& wall) {
  return wall.normal.dot(box.pose.position) - wall.offset - reachAlong(box, wall.normal);
}

}  // namespace careen
