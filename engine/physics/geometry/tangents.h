#pragma once

#include "core/math/linear_algebra.h"

namespace careen {

/// Two unit vectors that complete a unit normal to a right-handed orthonormal frame. A normal mirrored in a
/// coordinate plane has the mirrored tangents, up to sign.
struct Tangents {
  Vec3 first;
  Vec3 second;
};
Tangents tangentsOf(const Vec3& normal);

}  // namespace careen
