#pragma once

#include <optional>

namespace careen {

enum class Method : int;  // see world/method.h

/// Error figures of a run.
struct RunFigures {
  double energyChange = 0;  ///< [1] largest change not accounted for by impacts, springs, drag and friction,
                            ///< relative to the largest kinetic plus spring energy the run should have had
  double momentumChange =
      0;  ///< [1] largest relative change in flight, linear and angular, beyond what forces give
  double orthogonality = 0;                ///< [1] largest ‖AAᵀ−1‖
  double deepestPenetration = 0;           ///< [m]
  std::optional<double> boundedFrom = {};  ///< [s] time at which method exact switched to a pile, if it did
};

struct RunSettings {
  Method method{};          ///< kExact unless said otherwise
  double duration = 0;      ///< [s]
  double dt = 1.0 / 240;    ///< [s] time step of stepping methods
  double tolerance = 1e-6;  ///< [m] of positions and corners, for methods with step size control
};

}  // namespace careen
