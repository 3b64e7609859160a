#pragma once

#include "core/math/pose.h"
#include "physics/world/world.h"

namespace careen {

/// A solid box at a place, that of its middle; half sizes [m].
struct AuditBox {
  Vec3 halfExtents;
  Pose pose;
};

/// The box of a body, given the body's pose.
AuditBox auditBox(const Body& body, const Pose& pose);

/// Signed distance [m] of two boxes by separating axes: the three face normals of each and the nine cross
/// products of their edges. Negative: they overlap, and it is the least translation that parts them, as far
/// as these axes tell. Positive: they are at least that far apart. NaN if a pose is not finite.
double separationOf(const AuditBox& a, const AuditBox& b);

/// Signed distance [m] of a box's lowest corner from a wall; negative: behind it.
double separationOf(const AuditBox& box, const Wall& wall);

}  // namespace careen
