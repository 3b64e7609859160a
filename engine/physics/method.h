#pragma once

#include <stop_token>
#include <string_view>

#include "physics/recorder.h"
#include "physics/world.h"

namespace careen {

/// Ways to move a world. One line here, one in method.cpp.
enum class Method { kListing1 };

std::string_view methodName(Method method);

/// What a run says of its own errors.
struct RunFigures {
  double energyChange = 0;  ///< [1] largest change not accounted for by impacts, springs, drag and friction,
                            ///< relative to the run's largest kinetic plus spring energy
  double momentumChange =
      0;  ///< [1] largest relative change in flight, linear and angular, beyond what forces give
  double orthogonality = 0;       ///< [1] largest ‖AAᵀ−1‖
  double deepestPenetration = 0;  ///< [m]
};

struct RunSettings {
  Method method = Method::kListing1;
  double duration = 0;    ///< [s]
  double dt = 1.0 / 240;  ///< [s] methods that step
};

/// Runs the world from time 0 to `duration`. Throws NumericalError when the method cannot go on, Interrupted
/// when asked to stop.
RunFigures simulate(const World& world, const RunSettings& settings, Recorder& recorder,
                    const std::stop_token& stop = {});

}  // namespace careen
