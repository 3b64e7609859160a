#pragma once

#include "core/math/linear_algebra.h"

namespace careen {

/// Position and orientation of a body: a point b̄ fixed in it lies at position + worldFromBody · b̄ (Eq. 11).
struct Pose {
  Vec3 position = Vec3::Zero();           ///< [m] centre of mass, world
  Mat3 worldFromBody = Mat3::Identity();  ///< [1] special orthogonal (Eq. 1)

  Vec3 worldPoint(const Vec3& bodyPoint) const { return position + worldFromBody * bodyPoint; }
};

}  // namespace careen
