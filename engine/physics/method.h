#pragma once

#include <array>
#include <optional>
#include <stop_token>
#include <string_view>

#include "physics/recorder.h"
#include "physics/world.h"

namespace careen {

/// Ways to move a world: one line here, one in kMethods, one in simulate.
enum class Method { kExact, kListing1 };

/// Whether it moves the world step by step, each as long as RunSettings::dt.
constexpr bool hasSteps(Method method) { return method == Method::kListing1; }

struct NamedMethod {
  Method method;
  std::string_view name;  ///< as scene files and commands spell it
};
inline constexpr std::array kMethods = {NamedMethod{Method::kExact, "exact"},
                                        NamedMethod{Method::kListing1, "listing1"}};

constexpr std::string_view methodName(Method method) {
  for (const NamedMethod& known : kMethods) {
    if (known.method == method) {
      return known.name;
    }
  }
  return {};
}

constexpr std::optional<Method> methodNamed(std::string_view name) {
  for (const NamedMethod& known : kMethods) {
    if (known.name == name) {
      return known.method;
    }
  }
  return std::nullopt;
}

/// What a run says of its own errors.
struct RunFigures {
  double energyChange = 0;  ///< [1] largest change not accounted for by impacts, springs, drag and friction,
                            ///< relative to the largest kinetic plus spring energy the run should have had
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
