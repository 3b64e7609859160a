#include "physics/geometry/tangents.h"

#include <cmath>

namespace careen {

Tangents tangentsOf(const Vec3& normal) {
  Eigen::Index flattest = 0;
  for (Eigen::Index k = 1; k < 3; ++k) {
    flattest = std::fabs(normal[k]) < std::fabs(normal[flattest]) ? k : flattest;
  }
  const Vec3 across = normal.cross(Vec3(Vec3::Unit(flattest)));
  const Vec3 first = across / std::sqrt(dot(across, across));
  const Vec3 second = normal.cross(first);
  return {.first = first, .second = second};
}

}  // namespace careen
