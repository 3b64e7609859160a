#pragma once

#include "core/math/linear_algebra.h"
#include "exchange/mjcf_defaults.h"

namespace careen {

/// The inside of a geom, of even density.
struct MjcfSolid {
  double mass = 0;              ///< [kg]
  Vec3 moments = Vec3::Zero();  ///< [kg m²] about its middle, along its axes
};

/// Of a box, sphere, capsule, cylinder or ellipsoid; of anything else too if its mass or density is 0.
/// Otherwise, and if its size is none, InputError.
MjcfSolid solidOf(const MjcfDocument& document, const MjcfGeom& geom);

/// Refuses less or more than that many sizes, and sizes that are not above 0.
void checkSize(const MjcfDocument& document, const MjcfGeom& geom, std::size_t count);

}  // namespace careen
