#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/math/linear_algebra.h"

namespace careen {

/// Triangles whose corners run anticlockwise when seen from outside.
struct TriangleMesh {
  std::vector<Vec3> points;  ///< [m]
  std::vector<std::array<std::size_t, 3>> triangles;
};

/// A mesh that is drawn in place of a box. It lies within the box, in its frame, whose origin is the middle.
struct DrawnPart {
  std::size_t body = 0;
  TriangleMesh mesh;
};

}  // namespace careen
