#pragma once

#include <vector>

#include "physics/solver/contact_problem.h"

namespace careen {

/// Forces that give bodies the accelerations which they have: of all that are in their sets, as the contacts
/// of a problem admit them, those with the least sum of squares. So redundant contacts share evenly. Free
/// velocities of the problem are the accelerations without contacts less those that they have, and targets
/// mean nothing: q₀ + M⁻¹ Jᵀ λ = 0, whatever the contacts' law would say.
struct LeastForces {
  std::vector<ContactProblem::Triple> forces;  ///< λ [N]
  /// q, six per body [m/s², rad/s²]: what of the accelerations no forces in these sets give. Its norm, in the
  /// metric of M, is the least that there is.
  std::vector<double> left;
};

/// By Newton's method on the dual, whose gradient is Lipschitz (J. B. Hiriart-Urruty, J. J. Strodiot, V. H.
/// Nguyen, Appl. Math. Optim. 11, 1984): the forces are those nearest to Jᵀy of a motion y of the bodies, and
/// y is the minimum of ½|λ(y)|² − b·y. A proximal term makes it unique: where forces exist, it goes to zero.
LeastForces leastForces(const ContactProblem& problem);

}  // namespace careen
