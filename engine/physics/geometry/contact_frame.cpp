#include "physics/geometry/contact_frame.h"

#include <cmath>

namespace careen {

ContactFrame frameOf(const Vec3& normal) {
  Eigen::Index flattest = 0;
  for (Eigen::Index k = 1; k < 3; ++k) {
    flattest = std::fabs(normal[k]) < std::fabs(normal[flattest]) ? k : flattest;
  }
  const Vec3 across = normal.cross(Vec3(Vec3::Unit(flattest)));
  const Vec3 first = across / std::sqrt(dot(across, across));
  const Vec3 second = normal.cross(first);
  return {.normal = normal, .tangent1 = first, .tangent2 = second};
}

}  // namespace careen
