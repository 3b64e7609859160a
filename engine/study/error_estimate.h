#pragma once

#include <optional>
#include <stop_token>
#include <string>

#include "trajectory/trajectory.h"

namespace careen {

/// How wrong a run is, told by running it again a little otherwise: with half the step where the method takes
/// steps, else from a start one rounding away and with a tenth of the tolerance, for then rounding and the
/// steps of contact are all there is to be wrong by.
struct ErrorEstimate {
  std::string by;                 ///< what was done otherwise, in words
  double position = 0;            ///< [m] largest over all bodies, up to `until`
  double angle = 0;               ///< [rad] likewise
  double until = 0;               ///< [s] end of the run, or of what can be known of it
  std::optional<double> horizon;  ///< [s] from here on the two runs have nothing to do with each other
};

/// Moments at which the two runs are compared, evenly spread.
inline constexpr int kEstimateSamples = 256;
/// What it costs, in runs.
double estimateCost(Method method);

/// Estimates the error of `run`, which is `world` moved by run.settings. Where a method of order p takes
/// steps, the difference to half the step is taken times 2^p/(2^p−1) (Richardson). std::nullopt if the
/// repeated run cannot be finished though the first could.
std::optional<ErrorEstimate> estimateError(const World& world, const Trajectory& run,
                                           const std::stop_token& stop = {});

/// The same world, every component of position, velocity and angular momentum one rounding larger.
World oneRoundingAway(const World& world);

}  // namespace careen
