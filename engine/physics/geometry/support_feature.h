#pragma once

#include <array>

#include "core/math/linear_algebra.h"
#include "physics/geometry/box_at.h"

namespace careen {

/// The corner, edge or face of a box that lies furthest along a direction. Positions are relative to a box's
/// middle: what is symmetric about it stays so bitwise wherever the boxes are.
struct SupportFeature {
  Vec3 centre = Vec3::Zero();    ///< [m]
  int freedom = 0;               ///< 0 corner, 1 edge, 2 face
  std::array<Vec3, 2> axis;      ///< [1] directions along which it extends
  std::array<double, 2> half{};  ///< [m]

  double extent() const { return half[0] * half[1]; }
  SupportFeature seenFrom(const Vec3& place) const {
    SupportFeature moved = *this;
    moved.centre -= place;
    return moved;
  }
  Vec3 corner(double first, double second) const {
    Vec3 point = centre;
    if (freedom > 0) {
      point += first * half[0] * axis[0];
    }
    if (freedom > 1) {
      point += second * half[1] * axis[1];
    }
    return point;
  }
};

/// Of a box along a unit vector; parts within that distance [m] of the furthest belong to it.
SupportFeature furthest(const BoxAt& box, const Vec3& direction, double within);

}  // namespace careen
