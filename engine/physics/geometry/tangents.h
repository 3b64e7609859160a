#pragma once

#include "core/math/linear_algebra.h"

namespace careen {

/// Two unit vectors that complete a unit normal to a right-handed orthogonal frame. Mirrored in a coordinate
/// plane, a normal has the mirrored tangents, up to their signs.
struct Tangents {
  Vec3 first;
  Vec3 second;
};
Tangents tangentsOf(const Vec3& normal);

}  // namespace careen
