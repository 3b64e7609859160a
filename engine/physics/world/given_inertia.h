#pragma once

#include <string>

#include "physics/world/body.h"

namespace careen {

/// A body of any inside: mass [kg] and principal moments of inertia about its centre of mass, along its axes
/// [kg m²]. Both must satisfy whyNoInertia(), else InputError.
MassProperties massWithInertia(double mass, const Vec3& moments);

/// Why no rigid body has these principal moments; empty if one has. They are positive and finite, and none is
/// larger than the sum of the two others, since Iₓ + I_y − I_z = 2 Σ m z² (equal for a flat plate; to 1e-12).
std::string whyNoInertia(const Vec3& moments);

}  // namespace careen
