#include "audit/overlap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace careen {
namespace {

/// Sine of the angle between two edges below which they count as parallel: their cross product is then
/// rounding, and the normals of the faces tell the same.
constexpr double kParallelEdges = 1e-6;

// Half the extent of a box along a unit direction.
double reach(const AuditBox& box, const Vec3& direction) {
  return (box.pose.worldFromBody.transpose() * direction).cwiseAbs().dot(box.halfExtents);
}

}  // namespace

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
  const auto look = [&](const Vec3& axis) {
    const double gap = std::fabs(between.dot(axis)) - reach(a, axis) - reach(b, axis);
    finite = finite && std::isfinite(gap);
    widest = std::max(widest, gap);
  };
  for (int i = 0; i < 3; ++i) {
    look(a.pose.worldFromBody.col(i));
    look(b.pose.worldFromBody.col(i));
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec3 across = a.pose.worldFromBody.col(i).cross(b.pose.worldFromBody.col(j));
      const double sine = across.norm();
      if (sine > kParallelEdges) {
        look(across / sine);
      }
    }
  }
  return finite ? widest : std::numeric_limits<double>::quiet_NaN();
}

double separationOf(const AuditBox& box, const Wall& wall) {
  return wall.normal.dot(box.pose.position) - wall.offset - reach(box, wall.normal);
}

}  // namespace careen
