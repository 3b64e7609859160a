#pragma once

#include "physics/world/forces.h"

namespace careen {

/// One time step of Listing 1: explicit Euler with every right-hand side taken at step n,
///
///   r += h v      v += h F/M      A += h ω̃ A      L += h τ
///
/// then A is re-orthonormalised (Gram–Schmidt from column 0). ω is no state of its own: it is derived from L
/// and A when needed (Eqs. 18, 20). First order; the energy of a tumbling body grows with every step.
BodyState listing1Step(const MassProperties& mass, const BodyState& start, const Load& load, double h);

}  // namespace careen
