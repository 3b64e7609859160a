#pragma once

#include <optional>

#include "core/math/linear_algebra.h"
#include "physics/geometry/box_at.h"
#include "physics/geometry/contact_points.h"
#include "physics/geometry/separation.h"

namespace careen {

/// Contact points of two boxes that touch with parts of which neither is a face, and whose edges do not
/// cross: edges along edges, corners on edges, corners on corners. Their normal is the centre of a cone, see
/// boxContactPoints(). `axes` are those of the boxes, `bToA` [m] the way from b's middle to a's, `within` [m]
/// the distance of points that are one. None if the boxes touch otherwise.
std::optional<ContactPoints> pointsInCone(const BoxAt& a, const BoxAt& b, const BoxAxes& axes,
                                          const Vec3& bToA, double within);

}  // namespace careen
