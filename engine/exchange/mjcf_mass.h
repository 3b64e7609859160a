#pragma once

#include <optional>
#include <vector>

#include "core/math/linear_algebra.h"
#include "exchange/mjcf_defaults.h"
#include "exchange/mjcf_shape.h"

namespace careen {

struct MjcfMass {
  double mass = 0;              ///< [kg]
  Vec3 center = Vec3::Zero();   ///< [m] centre of mass, from the box's middle along its axes
  std::optional<Mat3> inertia;  ///< [kg m²] about it, along the box's axes; none: of a solid box
};

/// The mass of a body that collides as that shape, whose frame is that of `shape.geom`: of <inertial> if
/// there is one and <compiler inertiafromgeom> lets it count, else of all geoms of its inertiagrouprange, by
/// their masses or densities; then within boundmass, boundinertia and balanceinertia. Where the centre of
/// mass is the box's middle, or the principal axes its axes, to kMjcfCentered of its size and of the
/// inertia's trace, they are taken to be that. InputError if it lies outside the box, or if no body has that
/// inertia.
MjcfMass massOf(MjcfDocument& document, const std::vector<MjcfGeom>& geoms, const MjcfShape& shape,
                const XmlElement* inertial);
inline constexpr double kMjcfCentered = 1e-9;

/// [kg] Of a body that does not move, which counts for settotalmass.
double fixedMassOf(const MjcfDocument& document, const std::vector<MjcfGeom>& geoms,
                   const XmlElement* inertial);

}  // namespace careen
