#pragma once

#include <array>
#include <cstddef>

#include "core/math/linear_algebra.h"
#include "physics/geometry/contact_points.h"
#include "physics/geometry/support_feature.h"

namespace careen {

/// A convex polygon of at most four corners, clipped by at most four lines.
struct SharedPolygon {
  std::array<Vec3, ContactPoints::kMost> corner;
  std::size_t count = 0;

  void add(const Vec3& point) {
    if (count < corner.size()) {
      corner[count++] = point;
    }
  }
};

/// The part of a face or an edge over a face, both relative to the same centre; at least one point. `within`
/// [m]: how far beside the face still counts as over it.
SharedPolygon clip(const SupportFeature& incident, const SupportFeature& face, double within);

/// Whether some of a feature lies over a face, both relative to the same centre.
bool isOver(const SupportFeature& feature, const SupportFeature& face, double within);

}  // namespace careen
