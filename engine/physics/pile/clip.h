#pragma once

#include <array>
#include <cstdint>

#include "core/math/linear_algebra.h"
#include "physics/pile/body.h"

namespace careen {

/// A vertex of the polygon in which the projection of one box's face overlaps a face of another.
struct ClippedPoint {
  Vec3 point = Vec3::Zero();  ///< [m] on the incident face, in the frame of the box that owns the plane
  double gap = 0;             ///< [m] above the plane
  std::uint32_t feature =
      0;  ///< the two edges that cross there: 0…3 of the incident face, 4…7 of the reference face
};

struct ClippedFace {
  std::array<ClippedPoint, 8> points;
  int count = 0;
  std::uint32_t faces = 0;  ///< which two faces
};

/// The face of `incident` most antiparallel to the reference face `axis`, `sign` of `owner`, clipped to the
/// sides of that face moved outward by `slack` [m] (Sutherland & Hodgman, CACM 17, 1974). ownerFromIncident =
/// OᵀI, incident centre in the owner's frame.
ClippedFace clipFace(const PileBox& owner, const PileBox& incident, const Mat3& ownerFromIncident,
                     const Vec3& incidentCenter, int axis, double sign, double slack);

}  // namespace careen
