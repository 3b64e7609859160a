#pragma once

#include <algorithm>
#include <vector>

#include "core/math/linear_algebra.h"

namespace careen {

// Outlines of what is drawn, worked out beside the engine [px].

/// Convex hull of points of a picture, in order around it.
inline std::vector<Vec3> hull(std::vector<Vec3> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec3& a, const Vec3& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Vec3> result;
  const auto turnsRight = [&](const Vec3& p) {
    const Vec3& a = result[result.size() - 2];
    const Vec3& b = result.back();
    return (b - a).cross(p - b).z() <= 0;
  };
  for (int side = 0; side < 2; ++side) {
    const std::size_t begun = result.size();
    for (const Vec3& p : points) {
      while (result.size() >= begun + 2 && turnsRight(p)) {
        result.pop_back();
      }
      result.push_back(p);
    }
    result.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return result;
}

/// How far a point is inside a hull: the distance to the nearest edge's line.
inline double depthInside(const std::vector<Vec3>& outline, const Vec3& p) {
  double depth = 1e9;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3 edge = (outline[(i + 1) % outline.size()] - outline[i]).normalized();
    depth = std::min(depth, edge.cross(p - outline[i]).z());
  }
  return depth;
}

}  // namespace careen
