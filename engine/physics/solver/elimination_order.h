#pragma once

#include <cstddef>
#include <vector>

#include "physics/solver/contact_problem.h"

namespace careen {

/// Indices of the bodies in the order in which to eliminate them, by minimum degree (A. George, J. W. H. Liu,
/// SIAM Review 31, 1989). Of several, first comes the one that its masses and its place in the graph put
/// first, then the slower one, then the one listed first. So names matter only between bodies that symmetry
/// exchanges; mirroring, and powers of two as units, do not matter at all.
std::vector<std::size_t> eliminationOrder(const ContactProblem& problem);

}  // namespace careen
