#pragma once

#include <optional>

#include "core/math/linear_algebra.h"
#include "exchange/mjcf_defaults.h"

namespace careen {

struct MjcfMass {
  double mass = 0;              ///< [kg]
  std::optional<Vec3> inertia;  ///< [kg m²] along the box's axes; none: of a solid box
};

/// The mass of a body with one box: of <inertial> if there is one and <compiler inertiafromgeom> lets it
/// count, else of the box, by its mass or density. The centre of mass must be the box's centre, and the
/// principal axes its axes, to kMjcfCentered of its size and of the inertia's trace; else InputError.
MjcfMass massOf(MjcfDocument& document, const MjcfGeom& box, const XmlElement* inertial);
inline constexpr double kMjcfCentered = 1e-9;

}  // namespace careen
