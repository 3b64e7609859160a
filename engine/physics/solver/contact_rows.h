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

/// Of a point of the body: its velocity along each axis, times `sign`. `arm` [m]: world, from the centre
/// of mass to the point.
RowSide pointSide(const std::array<Vec3, 3>& axes, const Vec3& arm, double sign);

/// Writes the rows of a's side (0) or b's (1). Turning is along the principal axes, where the mass matrix is
/// diagonal.
void setSide(ContactProblem::Contact& contact, std::size_t side, const RowSide& rows,
             const Mat3& worldFromPrincipal);

}  // namespace careen
