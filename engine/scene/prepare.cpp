#include "scene/prepare.h"

#include <algorithm>
#include <cmath>

#include "core/brief.h"
#include "core/error.h"
#include "core/system/processor.h"
#include "physics/world/method.h"
#include "scene/plan.h"
#include "scene/starts.h"

namespace careen {
namespace {

constexpr int kDigits = 6;  // of numbers in messages

void apply(const RunOverrides& overrides, const Overridden& tell, Scene& scene) {
  const auto methodName = [&scene] { return std::string(traitsOf(scene.settings.method).name); };
  if (overrides.method && *overrides.method != scene.settings.method) {
    const std::string inScene = methodName();
    scene.settings.method = *overrides.method;
    tell("method", methodName(), inScene);
  }
  const auto replace = [&](const char* name, const std::optional<double>& given, bool used, double& inScene) {
    if (!given) {
      return;
    }
    const std::string option = overrides.sign + name;
    const std::string found = option + ": found " + brief(*given, kDigits);
    if (!used) {
      throw InputError(found + ", but method " + methodName() + " does not use it; expected no " + option);
    }
    if (!(*given > 0 && std::isfinite(*given))) {
      throw InputError(found + ", expected a positive number");
    }
    if (*given != inScene) {
      tell(name, brief(*given, kDigits), brief(inScene, kDigits));
    }
    inScene = *given;
  };
  const bool steps = traitsOf(scene.settings.method).steps();
  replace("dt", overrides.dt, steps, scene.settings.dt);
  replace("tolerance", overrides.tolerance, !steps, scene.settings.tolerance);
  replace("duration", overrides.duration, true, scene.settings.duration);
}

int threadsOf(const RunOverrides& overrides) {
  const int threads = overrides.threads.value_or(std::min(usableCores(), kMostThreadsOfCrowds));
  if (threads < 1 || threads > kMostThreadsOfCrowds) {
    throw InputError(overrides.sign + "threads: found " + std::to_string(threads) + ", expected 1 to " +
                     std::to_string(kMostThreadsOfCrowds));
  }
  return threads;
}

// A method that steps may take very many steps for each segment that it records.
void checkSteps(const Scene& scene, const RunOverrides& overrides) {
  constexpr double kStepsOfRecord = 200;
  const double most = kStepsOfRecord * static_cast<double>(overrides.most);
  const double steps = scene.settings.duration / scene.settings.dt * static_cast<double>(scene.boxes.size());
  if (traitsOf(scene.settings.method).steps() && !(steps <= most)) {
    throw InputError("dt: found " + brief(scene.settings.dt) + " s for " + brief(scene.settings.duration) +
                     " s, which makes " + brief(steps) + " steps of boxes, expected at most " + brief(most) +
                     "; " + overrides.sign + "limit allows more");
  }
}

}  // namespace

PreparedRun prepare(Scene scene, const RunOverrides& overrides, const Overridden& tell) {
  const Method method = scene.settings.method;
  apply(overrides, tell, scene);
  PreparedRun run;
  if (overrides.allowOverlap) {
    run.parted = moveApart(scene);
  } else if (scene.settings.method != method) {
    checkApart(scene);  // the reader checked it for the method in the file
  }
  checkSteps(scene, overrides);
  run.setup = setupOf(scene);
  run.setup.settings.threads = threadsOf(overrides);
  return run;
}

}  // namespace careen
