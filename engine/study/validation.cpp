#include "study/validation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

#include "core/brief.h"
#include "core/error.h"
#include "core/math/pose_difference.h"
#include "core/system/clock.h"
#include "core/table.h"
#include "physics/world/given_inertia.h"
#include "physics/world/method.h"
#include "scene/plan.h"
#include "study/flight_fit.h"
#include "trajectory/given_run.h"

namespace careen {
namespace {

constexpr int kMostRefits = 3;

bool canMove(const Body& body) { return !isImmovable(body.mass); }

// A measurement begins at any time.
PoseTable fromItsStart(PoseTable table) {
  table.beginAtZero();
  return table;
}

void apply(const Setting& setting, World& world) {
  const auto set = [&](Material& material) {
    (setting.parameter == Parameter::kFriction ? material.friction : material.restitution) = setting.value;
  };
  for (Body& body : world.bodies) {
    if (setting.parameter != Parameter::kInertia) {
      set(body.material);
    } else if (canMove(body)) {
      const MassProperties scaled = massWithInertia(body.mass.mass, setting.value * body.mass.inertiaBody);
      body.mass.inertiaBody = scaled.inertiaBody;
      body.mass.inverseInertiaBody = scaled.inverseInertiaBody;
    }
  }
  for (Wall& wall : world.walls) {
    if (setting.parameter != Parameter::kInertia) {
      set(wall.material);
    }
  }
}

Trajectory simulated(const RunSetup& setup, const std::vector<BodyState>& starts,
                     const std::stop_token& stop) {
  RunSetup begun = setup;
  for (std::size_t body = 0; body < starts.size(); ++body) {
    if (canMove(begun.world.bodies[body])) {
      begun.world.bodies[body].initial = starts[body];
    }
  }
  return record(std::move(begun), stop);
}

// [s] When a body first meets anything; the end if never.
double firstImpact(const Trajectory& run, std::size_t body) {
  const int index = static_cast<int>(body);
  for (const Impact& impact : run.impacts) {
    if (impact.a.value == index || impact.b.isBody(index)) {
      return impact.time;
    }
  }
  return run.settings.duration;
}

/// The rows of one box before a moment.
struct Rows {
  std::vector<double> times;
  std::vector<Vec3> positions;
  std::vector<Quat> attitudes;
};

Rows rowsBefore(const Trajectory& measured, std::size_t body, double time) {
  Rows rows;
  for (const Segment& segment : measured.tracks[body].segments) {
    if (segment.start < time) {
      const Pose pose = measured.state(body, segment.start).pose;
      rows.times.push_back(segment.start);
      rows.positions.push_back(pose.position);
      rows.attitudes.emplace_back(pose.worldFromBody);
    }
  }
  if (rows.times.size() > kFewestFitted) {  // the last may hold some of the impact
    rows.times.pop_back();
    rows.positions.pop_back();
    rows.attitudes.pop_back();
  }
  return rows;
}

/// The starts of all bodies, and the fits that they come from or could.
struct TossStarts {
  std::vector<BodyState> states;
  std::vector<std::optional<FlightFit>> fits;
  std::size_t rows = 0;  // of the fits
};

// When a body first strikes depends on its start, and its start on the rows before that.
TossStarts startsOf(const RunSetup& setup, const Trajectory& measured, const std::stop_token& stop) {
  const std::vector<Body>& bodies = setup.world.bodies;
  TossStarts starts;
  starts.fits.resize(bodies.size());
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    starts.states.push_back(measured.state(body, 0));
  }
  for (int refit = 0; refit < kMostRefits; ++refit) {
    const Trajectory run = simulated(setup, starts.states, stop);
    starts.rows = 0;
    bool changed = false;
    for (std::size_t body = 0; body < bodies.size(); ++body) {
      const Rows rows = canMove(bodies[body]) ? rowsBefore(measured, body, firstImpact(run, body)) : Rows();
      if (rows.times.size() < kFewestFitted) {
        continue;
      }
      starts.rows += rows.times.size();
      starts.fits[body] =
          fitFlight(bodies[body].mass, setup.world.gravity,
                    {.times = rows.times, .positions = rows.positions, .attitudes = rows.attitudes});
      changed = changed || (starts.fits[body]->start.velocity - starts.states[body].velocity).norm() > 0;
      starts.states[body] = starts.fits[body]->start;
    }
    if (!changed) {
      break;
    }
  }
  return starts;
}

std::string faceUp(const Pose& pose, const Vec3& up) {
  const Vec3 seen = pose.worldFromBody.transpose() * up;
  Eigen::Index axis = 0;
  seen.cwiseAbs().maxCoeff(&axis);
  std::string face(seen[axis] > 0 ? "+" : "-");
  face += "xyz"[axis];
  return face;
}

/// Mean distances of the boxes of two runs at one time.
struct Apart {
  double place = 0;
  double attitude = 0;
};

Apart apartAt(const Trajectory& a, const Trajectory& b, double time) {
  Apart apart;
  double count = 0;
  for (std::size_t body = 0; body < a.tracks.size(); ++body) {
    if (canMove(a.world.bodies[body])) {
      const PoseDifference difference = differenceOf(a.state(body, time).pose, b.state(body, time).pose, 1);
      apart.place += difference.position;
      apart.attitude += difference.angle;
      count += 1;
    }
  }
  return {apart.place / count, apart.attitude / count};
}

double meanOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

// Runs from starts as likely as the fitted one, against the run from that one.
void findFloor(const RunSetup& setup, const TossStarts& starts, const ValidationSettings& settings,
               const std::stop_token& stop, Toss& toss) {
  const bool isKnown =
      std::any_of(starts.fits.begin(), starts.fits.end(), [](const auto& fit) { return fit.has_value(); });
  if (!isKnown || settings.floorRuns < 1) {
    return;
  }
  constexpr std::uint64_t kSeed = 1;  // the same floor for the same measurement
  std::mt19937_64 random(kSeed);
  const Trajectory run = simulated(setup, starts.states, stop);
  double place = 0;
  double attitude = 0;
  for (int k = 0; k < settings.floorRuns; ++k) {
    std::vector<BodyState> states = starts.states;
    for (std::size_t body = 0; body < states.size(); ++body) {
      if (starts.fits[body]) {
        states[body] = startNear(*starts.fits[body], setup.world.bodies[body].mass, random);
      }
    }
    const Trajectory other = simulated(setup, states, stop);
    for (const double time : toss.times) {
      const Apart apart = apartAt(run, other, time);
      place += apart.place;
      attitude += apart.attitude;
    }
  }
  const double count = static_cast<double>(toss.times.size()) * settings.floorRuns;
  toss.floorPlace = place / count;
  toss.floorAttitude = attitude / count;
}

}  // namespace

RunSetup setupOfMeasured(const Scene& scene) {
  Scene whole = scene;
  whole.settings.method = Method::kExact;
  return setupOf(whole);
}

Toss validate(const RunSetup& scene, const PoseTable& measuredTable, const ValidationSettings& settings,
              const std::stop_token& stop, Trajectory* simulatedRun) {
  RunSetup setup = scene;
  if (settings.setting) {
    apply(*settings.setting, setup.world);
  }
  const Trajectory measured = givenRun(setup, fromItsStart(measuredTable));
  setup.settings.duration = measured.settings.duration;
  const TossStarts starts = startsOf(setup, measured, stop);
  Toss toss;
  toss.name = measuredTable.name;
  toss.fitted = starts.rows;
  for (std::size_t body = 0; body < starts.fits.size(); ++body) {
    if (starts.fits[body]) {
      toss.positionNoise = std::max(toss.positionNoise, starts.fits[body]->positionNoise);
      toss.attitudeNoise = std::max(toss.attitudeNoise, starts.fits[body]->attitudeNoise);
    }
  }
  std::vector<BodyState> states = starts.states;
  if (settings.start == MeasuredStart::kFirst) {
    for (std::size_t body = 0; body < states.size(); ++body) {
      states[body] = measured.state(body, 0);
    }
    toss.fitted = 0;
  }
  const auto begun = Clock::now();
  const Trajectory run = simulated(setup, states, stop);
  toss.seconds = secondsSince(begun);
  toss.impacts = run.impacts.size();
  const auto first = std::find_if(setup.world.bodies.begin(), setup.world.bodies.end(), canMove);
  const auto body = static_cast<std::size_t>(first - setup.world.bodies.begin());
  for (const Segment& segment : measured.tracks[body].segments) {
    toss.times.push_back(segment.start);
  }
  toss.times.push_back(setup.settings.duration);
  for (const double time : toss.times) {
    const Apart apart = apartAt(measured, run, time);
    toss.place.push_back(apart.place);
    toss.attitude.push_back(apart.attitude);
  }
  toss.meanPlace = meanOf(toss.place);
  toss.largestPlace = *std::max_element(toss.place.begin(), toss.place.end());
  toss.meanAttitude = meanOf(toss.attitude);
  toss.largestAttitude = *std::max_element(toss.attitude.begin(), toss.attitude.end());
  const Vec3 gravity = setup.world.gravity;
  const Vec3 up = gravity.isZero(0) ? Vec3::UnitZ() : Vec3(-gravity.normalized());
  toss.measuredFace = faceUp(measured.state(body, setup.settings.duration).pose, up);
  toss.simulatedFace = faceUp(run.state(body, setup.settings.duration).pose, up);
  findFloor(setup, starts, settings, stop, toss);
  if (simulatedRun != nullptr) {
    *simulatedRun = run;
  }
  return toss;
}

double sizeOf(const World& world) {
  double logarithms = 0;
  double count = 0;
  for (const Body& body : world.bodies) {
    if (canMove(body)) {
      logarithms += std::log(8 * body.halfExtents.prod()) / 3;
      count += 1;
    }
  }
  return count > 0 ? std::exp(logarithms / count) : 1;
}

std::optional<double> valueOf(const World& world, Parameter parameter) {
  if (parameter == Parameter::kInertia) {
    return 1;
  }
  std::optional<double> value;
  const auto agrees = [&](const Material& a, const Material& b) {
    const Material pair = touching(a, b);
    const double here = parameter == Parameter::kFriction ? pair.friction : pair.restitution;
    if (!value) {
      value = here;
    }
    return *value == here;
  };
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const Material& own = world.bodies[i].material;
    for (const Wall& wall : world.walls) {
      if (!agrees(own, wall.material)) {
        return std::nullopt;
      }
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (!agrees(own, world.bodies[j].material)) {
        return std::nullopt;
      }
    }
  }
  return value;
}

Spread spreadOf(const std::vector<Toss>& tosses, double Toss::*figure) {
  Spread spread;
  const auto count = static_cast<double>(tosses.size());
  for (const Toss& toss : tosses) {
    spread.mean += toss.*figure / count;
  }
  for (const Toss& toss : tosses) {
    const double off = toss.*figure - spread.mean;
    spread.deviation += count > 1 ? off * off / (count - 1) : 0;
  }
  spread.deviation = std::sqrt(spread.deviation);
  return spread;
}

const SweepPoint& leastOf(const std::vector<SweepPoint>& points) {
  return *std::min_element(points.begin(), points.end(),
                           [](const SweepPoint& a, const SweepPoint& b) { return a.place < b.place; });
}

double minimumOf(const std::vector<SweepPoint>& points) {
  const SweepPoint& least = leastOf(points);
  if (&least == &points.front() || &least == &points.back()) {
    return least.value;
  }
  const SweepPoint& before = *std::prev(&least);
  const SweepPoint& after = *std::next(&least);
  const double left = (least.place - before.place) / (least.value - before.value);
  const double right = (after.place - least.place) / (after.value - least.value);
  // Where the slope of the parabola is 0: slopes left and right are those at the middles.
  const double middleLeft = 0.5 * (before.value + least.value);
  const double middleRight = 0.5 * (least.value + after.value);
  return right > left ? middleLeft - left * (middleRight - middleLeft) / (right - left) : least.value;
}

std::string tossesCsv(const std::vector<Toss>& tosses, double size) {
  Table table{.head = {"toss", "rows", "fitted", "impacts", "mean_place", "largest_place",
                       "mean_place_percent", "mean_attitude", "largest_attitude", "floor_place",
                       "floor_attitude", "position_noise", "attitude_noise", "measured_face",
                       "simulated_face", "seconds"}};
  for (const Toss& toss : tosses) {
    std::vector<TableCell>& row = table.rows.emplace_back();
    row.emplace_back(toss.name);
    for (const std::size_t count : {toss.times.size(), toss.fitted, toss.impacts}) {
      row.emplace_back(std::to_string(count));
    }
    for (const double number : {toss.meanPlace, toss.largestPlace, 100 * toss.meanPlace / size,
                                toss.meanAttitude, toss.largestAttitude, toss.floorPlace, toss.floorAttitude,
                                toss.positionNoise, toss.attitudeNoise}) {
      row.emplace_back(brief(number, 6));
    }
    row.insert(row.end(), {toss.measuredFace, toss.simulatedFace, brief(toss.seconds, 3)});
  }
  return table.csv();
}

std::string errorsCsv(const std::vector<Toss>& tosses) {
  Table table{.head = {"toss", "time", "place", "attitude"}};
  for (const Toss& toss : tosses) {
    for (std::size_t k = 0; k < toss.times.size(); ++k) {
      table.rows.push_back(
          {toss.name, inFull(toss.times[k]), brief(toss.place[k], 6), brief(toss.attitude[k], 6)});
    }
  }
  return table.csv();
}

std::string sweepCsv(const std::vector<SweepPoint>& points, Parameter parameter) {
  Table table{.head = {std::string(kParameterNames.at(static_cast<std::size_t>(parameter))), "mean_place",
                       "mean_attitude"}};
  for (const SweepPoint& point : points) {
    table.rows.push_back({inFull(point.value), brief(point.place, 6), brief(point.attitude, 6)});
  }
  return table.csv();
}

}  // namespace careen
