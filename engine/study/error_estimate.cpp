#include "study/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "physics/simulate.h"
#include "physics/world/method.h"
#include "physics/world/run_settings.h"
#include "study/difference.h"
#include "study/sampled_states.h"

namespace careen {
namespace {

std::vector<double> sampleTimes(double duration) {
  std::vector<double> times;
  for (int k = 1; k <= kEstimateSamples; ++k) {
    times.push_back(duration * k / kEstimateSamples);
  }
  return times;
}

std::vector<BodyState> statesAt(const Trajectory& run, double time) {
  std::vector<BodyState> states;
  for (std::size_t body = 0; body < run.tracks.size(); ++body) {
    states.push_back(run.state(body, time));
  }
  return states;
}

/// Where method exact takes time steps, in contact, the second run uses tolerances smaller by this factor.
constexpr double kToleranceDivisor = 10;
/// The error of a crowd goes with its step, and that with the root of the tolerance: 1.5 would do while the
/// error is smooth. Nine rows of dominoes and pours against exact contact at 1e-8, up to the horizon: 0.8 to
/// 5.6, median 2.6, and 37 in one; four covers seven of them.
constexpr double kCrowdMargin = 4;

bool hasCrowds(const Trajectory& run) { return run.figures.boundedFrom.has_value(); }

double errorOverDifference(const Trajectory& run) {
  const int order = traitsOf(run.settings.method).order;
  return order > 0 ? 1 / (1 - std::pow(0.5, order)) : hasCrowds(run) ? kCrowdMargin : 1;
}

}  // namespace

double estimateCost(const Trajectory& run) {
  return traitsOf(run.settings.method).steps() || hasCrowds(run) ? 2 : 1;
}

World oneRoundingAway(const World& world) {
  World moved = world;
  const auto away = [](Vec3& vector) { vector *= 1 + 0x1p-52; };
  for (Body& body : moved.bodies) {
    if (!isImmovable(body.mass)) {
      away(body.initial.pose.position);
      away(body.initial.velocity);
      away(body.initial.angularMomentum);
    }
  }
  return moved;
}

std::optional<ErrorEstimate> estimateError(const Trajectory& run, const std::stop_token& stop,
                                           const RunCallback& progress) {
  const World& world = run.world;
  const int order = traitsOf(run.settings.method).order;
  RunSettings settings = run.settings;
  settings.dt /= order > 0 ? 2 : 1;
  settings.tolerance /= kToleranceDivisor;
  settings.crowds.tolerance /= kToleranceDivisor;
  const std::vector<double> times = sampleTimes(settings.duration);
  SampledStates again(world, times);
  try {
    simulate(order > 0 ? world : oneRoundingAway(world), settings, again, stop, progress);
  } catch (const NumericalError&) {
    return std::nullopt;
  }
  const std::vector<std::vector<BodyState>> states = again.finish();
  const double whole = errorOverDifference(run);
  ErrorEstimate estimate;
  estimate.by =
      order > 0 ? "half the time step" : "a start one rounding error away and a tenth of the tolerance";
  for (std::size_t k = 0; k < times.size(); ++k) {
    const PoseDifference difference = differenceOf(world, statesAt(run, times[k]), states[k]);
    if (difference.relative > kHorizonDifference) {
      estimate.horizon = times[k];
      break;
    }
    estimate.position = std::max(estimate.position, whole * difference.position);
    estimate.angle = std::max(estimate.angle, whole * difference.angle);
    estimate.until = times[k];
  }
  return estimate;
}

}  // namespace careen
