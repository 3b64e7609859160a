#pragma once

#include "physics/world/world.h"

namespace careen {

/// Signed distance of a world point from a wall [m]; negative: behind it.
inline double gap(const WallPlane& wall, const Vec3& point) { return dot(wall.normal, point) - wall.offset; }
inline double gap(const Wall& wall, const Vec3& point) { return gap(WallPlane{wall.normal, wall.offset}, point); }

}  // namespace careen
