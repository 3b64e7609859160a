#include "physics/simulate.h"

#include <cmath>

#include "core/error.h"
#include "physics/attitude/free_methods.h"
#include "physics/compared/loop1997.h"
#include "physics/compared/stepped_world.h"
#include "physics/exact/exact_world.h"
#include "physics/world/method.h"
#include "physics/world/run_settings.h"

namespace careen {
namespace {

RunFigures runMethod(const World& world, const RunSettings& settings, Recorder& recorder,
                     const std::stop_token& stop) {
  switch (settings.method) {
    case Method::kExact:
      return ExactWorld(world, settings, recorder).run(stop);
    case Method::kListing1:
      return runLoop1997(world, settings, recorder, stop);
    default:
      return runStepped(world, settings, recorder, stop);
  }
}

}  // namespace

RunFigures simulate(const World& world, const RunSettings& settings, Recorder& recorder,
                    const std::stop_token& stop, const RunCallback& progress) {
  if (!(std::isfinite(settings.duration) && settings.duration >= 0)) {
    throw InputError("duration must be finite and not negative");
  }
  if (!(std::isfinite(settings.dt) && settings.dt > 0)) {
    throw InputError("dt must be finite and positive");
  }
  if (!progress) {
    return runMethod(world, settings, recorder, stop);
  }
  ProgressRecorder watched(world, settings.duration, recorder, progress);
  const RunFigures figures = runMethod(world, settings, watched, stop);
  watched.finish();
  return figures;
}

}  // namespace careen
