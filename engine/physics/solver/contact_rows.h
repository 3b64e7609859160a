#pragma once

#include <array>
#include <cstddef>

#include "core/math/linear_algebra.h"
#include "physics/solver/contact_problem.h"

namespace careen {

/// How fast a constraint's three coordinates change with one body's motion: l·v + t·ω, world frame.
struct RowSide {
  std::array<Vec3, 3> linear;   ///< l [1]
  std::array<Vec3, 3> turning;  ///< t [m]
};

/// What constraints give to a body.
struct BodyImpulse {
  Vec3 push = Vec3::Zero();   ///< [N s]
  Vec3 twist = Vec3::Zero();  ///< [N m s] about the centre of mass
};

/// Of impulses along the three rows [N s].
BodyImpulse impulseOf(const RowSide& side, const ContactProblem::Triple& impulse);

/// A constraint at one moment: three coordinates and how the motions of its bodies a and b change them. Rows
/// that it does not need are zero, not the first.
struct ConstraintRows {
  RowSide a;
  RowSide b;
  Vec3 gaps = Vec3::Zero();    ///< [m] the coordinates
  Vec3 rates = Vec3::Zero();   ///< [m/s]
  Vec3 biases = Vec3::Zero();  ///< [m/s²] theirs without accelerations of the bodies
};

/// Of a point of the body: its velocity along each axis, times `sign`. `arm` [m]: world, from the centre
/// of mass to the point.
RowSide pointSide(const std::array<Vec3, 3>& axes, const Vec3& arm, double sign);

/// Writes the rows of a's side (0) or b's (1). Turning is along the principal axes, where the mass matrix is
/// diagonal.
void setSide(ContactProblem::Contact& contact, std::size_t side, const RowSide& rows,
             const Mat3& worldFromPrincipal);

}  // namespace careen
