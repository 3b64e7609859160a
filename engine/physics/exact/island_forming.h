#pragma once

#include "physics/exact/bodies.h"
#include "physics/exact/encounter.h"

namespace careen {

/// Bodies joined by persisting contacts and springs continue as an island each, unless no contact is active
/// or nothing moves: sets what each of them does next.
void formIslands(Bodies& bodies, Encounter& encounter);

/// Whether velocities are the same, to the bit.
inline bool movesAlike(const BodyState& x, const BodyState& y) {
  return x.velocity == y.velocity && x.angularMomentum == y.angularMomentum;
}

}  // namespace careen
