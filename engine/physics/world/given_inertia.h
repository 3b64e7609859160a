#pragma once

#include <string>

#include "core/math/linear_algebra.h"
#include "physics/world/body.h"

namespace careen {

/// A body of any inside: mass [kg] and principal moments of inertia about its centre of mass, along its axes
/// [kg m²]. Both must satisfy whyNoInertia(), else InputError.
MassProperties massWithInertia(double mass, const Vec3& moments);

/// The same with a tensor [kg m²], body frame. One whose parts beside the diagonal are rounding is diagonal;
/// of another the principal moments and axes are found (principalAxes).
MassProperties massWithTensor(double mass, const Mat3& inertia);

/// Why no rigid body has this tensor; empty if one has: it is symmetric to 1e-9 of its trace, and its
/// principal moments are possible.
std::string whyNoTensor(const Mat3& inertia);

/// Why no rigid body has these principal moments; empty if one has. They are positive and finite, and none is
/// larger than the sum of the two others, since Iₓ + I_y − I_z = 2 Σ m z² (equal for a flat plate; to 1e-12).
std::string whyNoInertia(const Vec3& moments);

}  // namespace careen
