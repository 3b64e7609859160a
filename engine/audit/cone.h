#pragma once

#include <vector>

#include "core/math/linear_algebra.h"

namespace careen {

/// Forces that a wall can exert: along its normal [1], never pulling, with Coulomb friction.
struct WallForce {
  Vec3 normal = Vec3::UnitZ();
  double friction = 0;  ///< [1]
};

/// The part of `impulse` that no sum of forces of these walls can give: from its nearest point of their cone
/// to it. A friction cone is taken as the pyramid of twelve sides around it, so that it is never too small.
Vec3 beyondWalls(const Vec3& impulse, const std::vector<WallForce>& walls);

}  // namespace careen
