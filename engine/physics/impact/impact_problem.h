#pragma once

#include <span>

#include "physics/impact/impact_law.h"
#include "physics/solver/contact_problem.h"

namespace careen {

/// An impact as a contact problem: of the bodies only those that can move, in their order; q₀ the velocities
/// before. Throws NumericalError where both sides of a contact cannot move, or a number is not finite.
ContactProblem impactProblemOf(std::span<const ImpactBody> bodies, std::span<const ImpactContact> contacts);

}  // namespace careen
