#pragma once

#include "physics/exact/bodies.h"
#include "physics/motion/joined_steps.h"

namespace careen {

/// Of a body, by rank, that becomes a member of a crowd: as closely as its steps are to be recorded.
JoinedSteps newPath(const Bodies& bodies, int rank);
/// With what it did in so long [s] before that time, at which it is in this state.
JoinedSteps pathFrom(const Bodies& bodies, const Mover& body, const Instant& time, const BodyState& state,
                     const Quat& attitude, double length);

}  // namespace careen
