#pragma once

#include <cstddef>
#include <vector>

namespace careen {

/// Which contacts take part in a problem where some have a choice of normals (separatingAxes): these only
/// where the motion without them enters along all of them. They are added, all at once, to what `solve` is
/// given, until the motion that it finds enters none of the others: one to three times. A contact that was
/// added stays. `takes` [of each contact]: those without a choice, then those that take part.
///
/// `solve(takes)` finds a motion, or returns false; `enters(c)` tells whether that enters contact c along all
/// its directions. Returns false if a motion was not found.
template <class Solve, class Enters>
bool solveWithTakingPart(std::vector<char>& takes, const Solve& solve, const Enters& enters) {
  for (;;) {
    if (!solve(takes)) {
      return false;
    }
    const std::vector<char> before = takes;
    for (std::size_t c = 0; c < takes.size(); ++c) {
      takes[c] = before[c] != 0 || enters(c) ? 1 : 0;
    }
    if (takes == before) {
      return true;
    }
  }
}

}  // namespace careen
