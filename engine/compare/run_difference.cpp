#include "compare/run_difference.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <utility>

#include "core/brief.h"
#include "core/error.h"
#include "core/names.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

// With fewer impacts the growth cannot be attributed to them.
constexpr std::size_t kLeastImpactsToGrowBy = 3;
constexpr double kLeastGrowth = 10;  // beyond linear growth in time, which a different speed causes

bool sameBits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
template <class Matrix>
bool sameBits(const Matrix& a, const Matrix& b) {
  return std::equal(a.data(), a.data() + a.size(), b.data(),
                    [](double x, double y) { return sameBits(x, y); });
}
bool sameBits(const BodyState& a, const BodyState& b) {
  return sameBits(a.pose.position, b.pose.position) && sameBits(a.pose.worldFromBody, b.pose.worldFromBody) &&
         sameBits(a.velocity, b.velocity) && sameBits(a.angularMomentum, b.angularMomentum);
}
bool sameBits(const Impact& a, const Impact& b) {
  return sameBits(a.time, b.time) && sameBits(a.point, b.point) && sameBits(a.normal, b.normal) &&
         sameBits(a.approach, b.approach) && sameBits(a.impulse, b.impulse) &&
         sameBits(a.tangential, b.tangential);
}

// The motion of the boxes, in the order of their names, without how it was computed and without the rest of
// the scene file.
std::string motionBytes(const Trajectory& run) {
  Trajectory bare;
  bare.settings.duration = run.settings.duration;
  for (const std::size_t body : orderByName(run.world.bodies)) {
    const Body& moved = run.world.bodies[body];
    bare.world.bodies.push_back({.name = moved.name,
                                 .halfExtents = moved.halfExtents,
                                 .boxCenter = moved.boxCenter,
                                 .mass = moved.mass,
                                 .material = {},
                                 .initial = {}});
    bare.tracks.push_back(run.tracks[body]);
  }
  return encodeTrajectory(bare);
}

/// States of both runs, box by box in the order of the expected run.
class Pair {
 public:
  Pair(const Trajectory& expected, const Trajectory& actual, double until, RunDifference& found)
      : expected_(expected), actual_(actual) {
    std::map<std::string, std::size_t> places;
    for (std::size_t i = 0; i < actual.tracks.size(); ++i) {
      places[actual.world.bodies[i].name] = i;
    }
    for (const Body& body : expected.world.bodies) {
      const auto place = places.find(body.name);
      if (place == places.end()) {
        found.incomparable.push_back("box " + body.name + " is not there");
      } else {
        places_.push_back(place->second);
        places.erase(place);
      }
    }
    for (const auto& [name, place] : places) {
      found.incomparable.push_back("box " + name + " was not expected");
    }
    duration_ = std::min({expected.settings.duration, actual.settings.duration, until});
    const bool goesOn = duration_ < std::max(expected.settings.duration, actual.settings.duration);
    last_ = goesOn ? std::nextafter(duration_, 0) : duration_;
  }

  double duration() const { return duration_; }

  RunSample sampleAt(double time) const {
    RunSample sample{.time = time, .difference = {}, .body = {}};
    for (std::size_t body = 0; body < places_.size(); ++body) {
      const Body& moved = expected_.world.bodies[body];
      if (isImmovable(moved.mass)) {
        continue;
      }
      const PoseDifference difference =
          differenceOf(boxPose(moved, expectedState(body, time).pose),
                       boxPose(actual_.world.bodies[places_[body]], actualState(body, time).pose),
                       moved.halfExtents.norm());
      if (difference.relative > sample.difference.relative) {
        sample.body = moved.name;
      }
      sample.difference.include(difference);
    }
    return sample;
  }

  // Compares states at the start of each segment and at the end.
  std::optional<double> firstDifference() const {
    std::optional<double> first;
    for (std::size_t body = 0; body < places_.size(); ++body) {
      for (const double time : startsOf(body)) {
        if (first && time >= *first) {
          break;
        }
        if (!sameBits(expectedState(body, time), actualState(body, time))) {
          first = time;
        }
      }
    }
    return first;
  }

  std::pair<double, double> energies() const {
    std::pair<double, double> sums;
    for (std::size_t body = 0; body < places_.size(); ++body) {
      if (!isImmovable(expected_.world.bodies[body].mass)) {
        sums.first += kineticEnergy(expected_.world.bodies[body].mass, expectedState(body, duration_));
        sums.second += kineticEnergy(actual_.world.bodies[places_[body]].mass, actualState(body, duration_));
      }
    }
    return sums;
  }

 private:
  BodyState expectedState(std::size_t body, double time) const {
    return finite("the expected run", expected_, body, std::min(time, last_));
  }
  BodyState actualState(std::size_t body, double time) const {
    return finite("the actual run", actual_, places_[body], std::min(time, last_));
  }

  static BodyState finite(const char* name, const Trajectory& run, std::size_t body, double time) {
    BodyState state = run.state(body, time);
    if (!(state.pose.position.allFinite() && state.pose.worldFromBody.allFinite() &&
          state.velocity.allFinite() && state.angularMomentum.allFinite())) {
      throw InputError(std::string(name) + ": box " + run.world.bodies[body].name + " has a state at " +
                       brief(time) + " s that is not finite");
    }
    return state;
  }

  std::vector<double> startsOf(std::size_t body) const {
    std::vector<double> times = {duration_};
    for (const Track* track : {&expected_.tracks[body], &actual_.tracks[places_[body]]}) {
      for (const Segment& segment : track->segments) {
        if (segment.start <= duration_) {
          times.push_back(segment.start);
        }
      }
    }
    std::sort(times.begin(), times.end());
    return times;
  }

  const Trajectory& expected_;
  const Trajectory& actual_;
  std::vector<std::size_t> places_;  // index of each expected box in the actual run
  double duration_;
  double last_;  // no later time is compared: where one run ends, a longer one may have jumped
};

std::string howItDiffers(const Impact& a, const Impact& b) {
  std::string text;
  const auto add = [&text](const char* what, double difference, const char* unit) {
    if (difference != 0) {
      text += (text.empty() ? "" : ", ") + std::string(what) + " by " + brief(difference) + unit;
    }
  };
  add("time", b.time - a.time, " s");
  add("point", (b.point - a.point).norm(), " m");
  add("normal", (b.normal - a.normal).norm(), "");
  add("approach", b.approach - a.approach, " m/s");
  add("impulse", b.impulse - a.impulse, " N s");
  add("friction's impulse", b.tangential - a.tangential, " N s");
  return text.empty() ? "the sign of a zero" : text;
}

std::string bodiesOf(const Impact& impact, const Trajectory& run) {
  return run.world.bodies.at(static_cast<std::size_t>(impact.a.value)).name + " against " +
         run.partnerName(impact);
}

// Uses the impacts that `found` counts.
ImpactDifference impactsAt(std::size_t index, const Trajectory& expected, const Trajectory& actual,
                           const RunDifference& found) {
  ImpactDifference pair{
      .index = index, .expected = {}, .actual = {}, .expectedBodies = {}, .actualBodies = {}, .what = {}};
  if (index < found.expectedImpacts) {
    pair.expected = expected.impacts[index];
    pair.expectedBodies = bodiesOf(*pair.expected, expected);
  }
  if (index < found.actualImpacts) {
    pair.actual = actual.impacts[index];
    pair.actualBodies = bodiesOf(*pair.actual, actual);
  }
  if (!pair.expected) {
    pair.what = describe(*pair.actual, actual) + " was not expected";
  } else if (!pair.actual) {
    pair.what = describe(*pair.expected, expected) + " is not there";
  } else if (pair.expectedBodies != pair.actualBodies) {
    pair.what =
        "expected " + describe(*pair.expected, expected) + ", found " + describe(*pair.actual, actual);
  } else if (!sameBits(*pair.expected, *pair.actual)) {
    pair.what = describe(*pair.expected, expected) + ": " + howItDiffers(*pair.expected, *pair.actual);
  }
  return pair;
}

// The times of the table's rows up to `until` [s]; if both are tables, of the actual one's.
std::vector<double> rowTimes(const Trajectory& expected, const Trajectory& actual, double until) {
  const Trajectory& table = actual.given ? actual : expected;
  std::vector<double> times = {until};
  for (const Track& track : table.tracks) {
    for (const Segment& segment : track.segments) {
      if (segment.start <= until) {
        times.push_back(segment.start);
      }
    }
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

void compareRows(const Trajectory& expected, const Trajectory& actual, const Pair& pair, double tolerance,
                 RunDifference& found) {
  const std::vector<double> times = rowTimes(expected, actual, pair.duration());
  const std::size_t stride = 1 + times.size() / kRunSamples;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const RunSample sample = pair.sampleAt(times[k]);
    if (!found.firstTime && sample.difference.relative > tolerance) {
      found.firstTime = sample.time;
    }
    if (!found.horizon && sample.difference.relative > kHorizonDifference) {
      found.horizon = k == 0 ? 0 : times[k - 1];
    }
    if (!found.horizon && (k == 0 || sample.difference.relative > found.worst.difference.relative)) {
      found.worst = sample;
    }
    if (k % stride == 0 || k + 1 == times.size()) {
      found.growth.push_back(sample);
    }
  }
  const Trajectory& struck = expected.given ? actual : expected;
  const auto next = std::find_if(struck.impacts.begin(), struck.impacts.end(), [&](const Impact& impact) {
    return found.firstTime && impact.time > *found.firstTime;
  });
  if (found.firstTime && next != struck.impacts.begin()) {
    const auto index = static_cast<std::size_t>(std::prev(next) - struck.impacts.begin());
    ImpactDifference last{
        .index = index, .expected = {}, .actual = {}, .expectedBodies = {}, .actualBodies = {}, .what = {}};
    (expected.given ? last.actual : last.expected) = struck.impacts[index];
    (expected.given ? last.actualBodies : last.expectedBodies) = bodiesOf(struck.impacts[index], struck);
    last.what = describe(struck.impacts[index], struck);
    found.lastImpact = last;
  }
  found.expectedImpacts = expected.impacts.size();
  found.actualImpacts = actual.impacts.size();
}

std::size_t impactsUntil(const Trajectory& run, double until) {
  return static_cast<std::size_t>(
      std::count_if(run.impacts.begin(), run.impacts.end(),
                    [until](const Impact& impact) { return impact.time <= until; }));
}

void compareImpacts(const Trajectory& expected, const Trajectory& actual, double until,
                    RunDifference& found) {
  found.expectedImpacts = impactsUntil(expected, until);
  found.actualImpacts = impactsUntil(actual, until);
  const std::size_t impacts = std::max(found.expectedImpacts, found.actualImpacts);
  for (std::size_t i = 0; i < impacts && !found.firstOtherEvent; ++i) {
    const ImpactDifference pair = impactsAt(i, expected, actual, found);
    if (!pair.what.empty() && !found.firstImpact) {
      found.firstImpact = pair;
    }
    if (pair.expectedBodies != pair.actualBodies) {
      found.firstOtherEvent = pair;
    }
  }
  if (found.firstImpact) {
    const std::size_t first = found.firstImpact->index;
    for (std::size_t i = first - std::min(first, kImpactsBefore);
         i < std::min(impacts, first + kImpactsAfter + 1); ++i) {
      found.impactsAround.push_back(impactsAt(i, expected, actual, found));
    }
  }
}

// Measured from the first difference after the start to the last before the horizon.
std::optional<double> growthPerImpact(const RunDifference& found, const std::vector<Impact>& impacts) {
  const auto differs = [](const RunSample& sample) {
    return sample.difference.relative > 0 && sample.time > 0;
  };
  const auto from = std::find_if(found.growth.begin(), found.growth.end(), differs);
  if (from == found.growth.end() || !found.horizon) {
    return std::nullopt;
  }
  const auto to = std::find_if(from, found.growth.end(),
                               [&found](const RunSample& sample) { return sample.time > *found.horizon; });
  const auto last = to == from ? from : std::prev(to);
  const auto within = [&](const Impact& impact) {
    return impact.time > from->time && impact.time <= last->time;
  };
  const auto count = static_cast<std::size_t>(std::count_if(impacts.begin(), impacts.end(), within));
  const double growth = last->difference.relative / from->difference.relative;
  if (count < kLeastImpactsToGrowBy || growth < kLeastGrowth * last->time / from->time) {
    return std::nullopt;
  }
  return std::pow(growth, 1.0 / static_cast<double>(count));
}

}  // namespace

std::string describe(const Impact& impact, const Trajectory& run) {
  return "at " + brief(impact.time) + " s " + bodiesOf(impact, run) + " with " + brief(impact.impulse) +
         " N s";
}

RunDifference differenceOf(const Trajectory& expected, const Trajectory& actual, double until,
                           double tolerance) {
  RunDifference found;
  const Pair pair(expected, actual, until, found);
  const bool isTable = expected.given || actual.given;
  if (!isTable) {
    compareImpacts(expected, actual, until, found);
  }
  found.expectedDuration = expected.settings.duration;
  found.actualDuration = actual.settings.duration;
  if (!found.incomparable.empty()) {
    return found;
  }
  if (isTable) {
    compareRows(expected, actual, pair, tolerance, found);
    std::tie(found.expectedEnergy, found.actualEnergy) = pair.energies();
    return found;
  }
  found.firstTime = pair.firstDifference();
  for (int k = 0; k <= kRunSamples; ++k) {
    const RunSample sample = pair.sampleAt(pair.duration() * k / kRunSamples);
    if (!found.horizon && sample.difference.relative > kHorizonDifference) {
      found.horizon = found.growth.empty() ? 0 : found.growth.back().time;
    }
    if (!found.horizon && (k == 0 || sample.difference.relative > found.worst.difference.relative)) {
      found.worst = sample;
    }
    found.growth.push_back(sample);
  }
  const auto apart =
      std::find_if(found.growth.begin(), found.growth.end(), [&found](const RunSample& sample) {
        return sample.difference.relative > 0 && (!found.firstTime || sample.time < *found.firstTime);
      });
  if (apart != found.growth.end()) {
    found.firstTime = apart->time;
  }
  const bool whole =
      pair.duration() == expected.settings.duration && pair.duration() == actual.settings.duration;
  if (!whole && pair.duration() == until) {
    found.until = until;
  }
  found.sameBits = !found.firstTime && !found.firstImpact &&
                   (found.until || (whole && motionBytes(expected) == motionBytes(actual)));
  found.growthPerImpact = growthPerImpact(found, expected.impacts);
  std::tie(found.expectedEnergy, found.actualEnergy) = pair.energies();
  return found;
}

}  // namespace careen
