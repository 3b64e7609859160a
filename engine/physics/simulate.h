#pragma once

#include <stop_token>

#include "physics/motion/recorder.h"
#include "physics/motion/run_progress.h"
#include "physics/world/run_settings.h"
#include "physics/world/world.h"

namespace careen {

/// Runs the world from time 0 to `duration`. Throws NumericalError when the method cannot go on, Interrupted
/// when asked to stop. Who is told of the progress changes no bit of the run.
RunFigures simulate(const World& world, const RunSettings& settings, Recorder& recorder,
                    const std::stop_token& stop = {}, const RunCallback& progress = {});

}  // namespace careen
