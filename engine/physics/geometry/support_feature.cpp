#include "physics/geometry/support_feature.h"

#include <cmath>
#include <cstddef>

namespace careen {

SupportFeature furthest(const BoxAt& box, const Vec3& direction, double within) {
  const Pose& pose = box.pose;
  const Vec3& halfExtents = box.halfExtents;
  SupportFeature feature{.axis = {Vec3::Zero(), Vec3::Zero()}};
  const Vec3 along = pose.worldFromBody.transpose() * direction;
  // A box thinner than the tolerance still has two sides: its steepest axis never counts as level.
  int steepest = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::fabs(along(i)) > std::fabs(along(steepest))) {
      steepest = i;
    }
  }
  for (int i = 0; i < 3; ++i) {
    if (i != steepest && 2 * halfExtents(i) * std::fabs(along(i)) <= within) {
      const auto k = static_cast<std::size_t>(feature.freedom);
      feature.axis[k] = pose.worldFromBody.col(i);
      feature.half[k] = halfExtents(i);
      ++feature.freedom;
    } else {
      feature.centre += (along(i) > 0 ? halfExtents(i) : -halfExtents(i)) * pose.worldFromBody.col(i);
    }
  }
  return feature;
}

}  // namespace careen
