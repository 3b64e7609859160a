#pragma once

#include <stop_token>

#include "physics/motion/recorder.h"
#include "physics/world/method.h"
#include "physics/world/world.h"

namespace careen {

/// Moves the world by Listing 1 inside the loop of the article's sample program: step every body to the
/// target time and look at the corners there. Too deep: halve the time and try again. Touching: resolve one
/// corner at a time. Then go on to the end of the step. Corners meet walls only: the sample had no contact
/// between boxes, and no friction. Where the sample stopped on an assert (no progress, 100 impulses without
/// peace) this throws NumericalError, as it does for a state that is not finite and a start too deep in a
/// wall.
///
/// Every body is recorded over every step taken, and once more at the very end, with the state it ends in.
RunFigures runLoop1997(const World& world, const RunSettings& settings, Recorder& recorder,
                       const std::stop_token& stop);

}  // namespace careen
