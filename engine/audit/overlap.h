#pragma once

#include <vector>

#include "core/math/pose.h"
#include "physics/world/world.h"

namespace careen {

/// A solid box at a place, that of its middle; half sizes [m].
struct AuditBox {
  Vec3 halfExtents;
  Pose pose;
};

/// The boxes of a body, given the body's pose.
std::vector<AuditBox> auditBoxes(const Body& body, const Pose& pose);

/// [m] Half the extent of a box along a unit direction.
double reachAlong(const AuditBox& box, const Vec3& direction);

/// Calls `look` with each of the directions [1], unit, along which two boxes may be apart: the three face
/// normals of each and the up to nine cross products of their edges.
template <class Look>
void forEachAxis(const AuditBox& a, const AuditBox& b, const Look& look) {
  // Sine of the angle below which edges count as parallel: their cross product is then rounding, and the
  // normals of the faces tell the same.
  constexpr double kParallelEdges = 1e-6;
  for (int i = 0; i < 3; ++i) {
    look(Vec3(a.pose.worldFromBody.col(i)));
    look(Vec3(b.pose.worldFromBody.col(i)));
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec3 across = a.pose.worldFromBody.col(i).cross(b.pose.worldFromBody.col(j));
      const double sine = across.norm();
      if (sine > kParallelEdges) {
        look(Vec3(across / sine));
      }
    }
  }
}

/// Signed distance [m] of two boxes by separating axes: the three face normals of each and the nine cross
/// products of their edges. Negative: they overlap, and it is the least translation that parts them, as far
/// as these axes tell. Positive: they are at least that far apart. NaN if a pose is not finite.
double separationOf(const AuditBox& a, const AuditBox& b);

/// Signed distance [m] of a box's lowest corner from a wall; negative: behind it.
double separationOf(const AuditBox& box, const WallPlane& wall);

/// The same of two bodies at their poses, or of a body and a wall: of the boxes that are nearest.
double separationOf(const Body& a, const Pose& poseA, const Body& b, const Pose& poseB);
double separationOf(const Body& body, const Pose& pose, const WallPlane& wall);

}  // namespace careen
