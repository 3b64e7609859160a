#pragma once

#include <cstddef>
#include <vector>

#include "physics/solver/contact_problem.h"

namespace careen {

/// Indices of the bodies in the order in which to eliminate them, by minimum degree (A. George, J. W. H. Liu, SIAM
/// Review 31, 1989). Of several, the one comes first whose place in the graph and masses say so, then whose
/// velocity, then the one listed first.
std::vector<std::size_t> eliminationOrder(const ContactProblem& problem);

}  // namespace careen
