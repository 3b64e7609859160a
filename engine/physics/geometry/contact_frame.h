#pragma once

#include <array>

#include "core/math/linear_algebra.h"

namespace careen {

/// Right-handed orthonormal directions at a contact, in the world: normal, tangent, tangent.
struct ContactFrame {
  using Triple = std::array<double, 3>;  ///< along them

  Vec3 normal = Vec3::UnitZ();
  Vec3 tangent1 = Vec3::UnitX();
  Vec3 tangent2 = Vec3::UnitY();

  std::array<Vec3, 3> axes() const { return {normal, tangent1, tangent2}; }
  Triple along(const Vec3& v) const { return {dot(v, normal), dot(v, tangent1), dot(v, tangent2)}; }
  Vec3 across(double x, double y) const { return x * tangent1 + y * tangent2; }
  Vec3 inWorld(const Triple& parts) const { return parts[0] * normal + across(parts[1], parts[2]); }
};

/// Of a unit normal. A normal mirrored in a coordinate plane has the mirrored tangents, up to sign.
ContactFrame frameOf(const Vec3& normal);

}  // namespace careen
