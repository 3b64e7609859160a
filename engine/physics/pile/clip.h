#pragma once

#include <array>
#include <cstdint>

#include "core/math/linear_algebra.h"
#include "physics/pile/body.h"

namespace careen {

/// A corner of the polygon in which the shadow of one box's face lies on a face of another.
struct ClippedPoint {
  Vec3 point = Vec3::Zero();  ///< [m] on the incident face, in the frame of the box that owns the plane
  double gap = 0;             ///< [m] above the plane
  std::uint32_t feature =
      0;  ///< the two edges that cross there: of the incident face 0…3, of the plane's 4…7
};

struct ClippedFace {
  std::array<ClippedPoint, 8> points;
  int count = 0;
  std::uint32_t faces = 0;  ///< which two faces
};

/// The face of `incident` that looks most against the face `axis`, `sign` of `owner`, clipped to its sides
/// moved outward by `slack` [m] (Sutherland & Hodgman, CACM 17, 1974). ownerFromIncident = OᵀI, and the
/// incident centre in the owner's frame.
ClippedFace clipFace(const PileBody& owner, const PileBody& incident, const Mat3& ownerFromIncident,
                     const Vec3& incidentCenter, int axis, double sign, double slack);

}  // namespace careen
