#include "runs/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "core/error.h"
#include "physics/simulate.h"
#include "physics/world/method.h"
#include "physics/world/run_settings.h"
#include "runs/difference.h"
#include "runs/sampled_states.h"

namespace careen {
namespace {

std::vector<double> sampleTimes(double duration) {
  std::vector<double> times;
  for (int k = 1; k <= kEstimateSamples; ++k) {
    times.push_back(duration * k / kEstimateSamples);
  }
  return times;
}

/// The error of a crowd goes with its step, and that with the root of the tolerance: 1.5 would do while the
/// error is smooth. Nine rows of dominoes and pours against exact contact at 1e-8, up to the horizon: 0.8 to
/// 5.6, median 2.6, and 37 in one; four covers seven of them.
constexpr double kCrowdMargin = 4;
/// In contact, see estimateError(): on the scenes that it was chosen on the larger of two differences times
/// 1.25 would do in 96 %; of one alone, times 5.5 in 98 %. Of the five places among 121 that
/// three times misses, ten times misses three.
constexpr double kContactMargin = 3;
constexpr double kHolds = 0.95;

bool hasCrowds(const Trajectory& run) { return run.figures.boundedFrom.has_value(); }

bool hasContactSteps(const Trajectory& run) {
  return std::any_of(run.tracks.begin(), run.tracks.end(), [](const Track& track) {
    return std::any_of(track.segments.begin(), track.segments.end(), [](const Segment& segment) {
      return std::holds_alternative<ContactStep>(segment.motion);
    });
  });
}

/// Other runs of the same scene, and what their difference says.
struct OtherSettings {
  std::string by;
  std::vector<RunSettings> others;
  double margin = 1;  // the error over the largest difference
  std::optional<double> holds = {};
};

OtherSettings otherSettingsFor(const Trajectory& run) {
  const int order = traitsOf(run.settings.method).order;
  if (order > 0) {
    RunSettings finer = run.settings;
    finer.dt /= 2;
    return {.by = "half the time step", .others = {finer}, .margin = 1 / (1 - std::pow(0.5, order))};
  }
  const auto with = [&](double divisor) {
    RunSettings finer = run.settings;
    finer.tolerance /= divisor;
    finer.crowds.tolerance /= divisor;
    return finer;
  };
  const std::string away = "a start one rounding error away and a tenth of the tolerance";
  if (!hasCrowds(run) && hasContactSteps(run)) {
    return {.by = away + ", and a hundredth",
            .others = {with(10), with(100)},
            .margin = kContactMargin,
            .holds = kHolds};
  }
  return {.by = away, .others = {with(10)}, .margin = hasCrowds(run) ? kCrowdMargin : 1};
}

}  // namespace

double estimateCost(const Trajectory& run) {
  return traitsOf(run.settings.method).steps() || hasCrowds(run) ? 2 : hasContactSteps(run) ? 3 : 1;
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
  const World start = traitsOf(run.settings.method).order > 0 ? world : oneRoundingAway(world);
  const OtherSettings other = otherSettingsFor(run);
  const std::vector<double> times = sampleTimes(run.settings.duration);
  std::vector<std::vector<std::vector<BodyState>>> others;  // of each run, by time and body
  for (const RunSettings& settings : other.others) {
    SampledStates again(world, times);
    try {
      simulate(start, settings, again, stop, progress);
    } catch (const NumericalError&) {
      return std::nullopt;
    }
    others.push_back(again.finish());
  }
  ErrorEstimate estimate{.by = other.by, .holds = other.holds};
  for (std::size_t k = 0; k < times.size(); ++k) {
    PoseDifference largest;
    for (const std::vector<std::vector<BodyState>>& states : others) {
      largest.include(differenceOf(world, run.states(times[k]), states[k]));
    }
    if (largest.relative > kHorizonDifference) {
      estimate.horizon = times[k];
      break;
    }
    estimate.position = std::max(estimate.position, other.margin * largest.position);
    estimate.angle = std::max(estimate.angle, other.margin * largest.angle);
    estimate.until = times[k];
  }
  return estimate;
}

}  // namespace careen
