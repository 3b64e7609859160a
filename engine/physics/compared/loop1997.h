#pragma once

#include <stop_token>

#include "physics/motion/recorder.h"
#include "physics/world/run_settings.h"
#include "physics/world/world.h"

namespace careen {

/// Simulates the world by Listing 1 inside the loop of the article's sample program: step every body to the
/// target time and test the corners there. Penetrating: halve the time and try again. Colliding: resolve one
/// corner at a time. Then go on to the end of the step. Corners collide with walls only: the sample had no
/// contact between boxes, and no friction. Where the sample stopped on an assert (no progress, 100 impulses
/// without separation) this throws NumericalError, as it does for a non-finite state and a start too deep in
/// a wall.
///
/// Every body is recorded over every step taken, and once more at the end, with its final state.
RunFigures runLoop1997(const World& world, const RunSettings& settings, Recorder& recorder,
                       const std::stop_token& stop);

}  // namespace careen
