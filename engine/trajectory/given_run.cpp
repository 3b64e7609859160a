#include "trajectory/given_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "core/brief.h"
#include "core/error.h"
#include "core/math/elementary.h"
#include "core/math/pose_difference.h"
#include "trajectory/run_check.h"

namespace careen {
namespace {

constexpr double kGivenPlace =
    1e-6;  // [1] of half diagonals or radians: a fixed box's pose in scene and table

// The rotation [rad] along its axis; of a unit quaternion with w < 0 it is more than half a turn.
Vec3 rotationVector(const Quat& q) {
  const double sine = q.vec().norm();
  const double half = elementary::atan2(sine, q.w());
  return sine > 0 ? Vec3(2 * half / sine * q.vec()) : Vec3(2 * q.vec());
}

// Rate at sample `k`; `valueAt(j)` is that at sample j, as a vector.
template <class ValueAt>
Vec3 rateAt(std::span<const double> times, std::size_t k, ValueAt valueAt) {
  const auto slope = [&](std::size_t i, std::size_t j) -> Vec3 {
    return (valueAt(j) - valueAt(i)) / (times[j] - times[i]);
  };
  const std::size_t count = times.size();
  if (count < 2) {
    return Vec3::Zero();
  }
  if (count == 2) {
    return slope(0, 1);
  }
  // Parabolas through samples first, first + 1, first + 2: half their second derivative.
  std::array<Vec3, 3> curvature;
  std::optional<std::size_t> best;
  const std::size_t middle = 1;
  for (const std::size_t offset : {middle, std::size_t{0}, std::size_t{2}}) {
    if (k + offset < 2 || k + offset >= count) {
      continue;
    }
    const std::size_t first = k + offset - 2;
    curvature.at(offset) =
        (slope(first + 1, first + 2) - slope(first, first + 1)) / (times[first + 2] - times[first]);
    if (!best || 2 * curvature.at(offset).norm() < curvature.at(*best).norm()) {
      best = offset;
    }
  }
  // Newton's form: from the earlier neighbour, or from the later one.
  return *best == 2 ? Vec3(slope(k, k + 1) - (times[k + 1] - times[k]) * curvature[2])
                    : Vec3(slope(k - 1, k) + (times[k] - times[k - 1]) * curvature.at(*best));
}

/// The samples of one box.
struct Samples {
  std::vector<double> times;
  std::vector<BodyState> states;
};

class Giving {
 public:
  Giving(RunSetup setup, const PoseTable& table) : table_(table) {
    static_cast<RunSetup&>(run_) = std::move(setup);
    run_.given = GivenPoses{.velocities = table.hasVelocities,
                            .angularVelocities = table.hasAngularVelocities,
                            .quaternionError = table.quaternionError};
  }

  Trajectory run() {
    if (hasCourses(run_.world)) {
      throw InputError(table_.name +
                       ": its scene has " + whatHasCourses(run_.world) +
                       " that move; expected one whose fixed boxes and walls are still");
    }
    if (run_.world.gravityPath == GravityPath::kLinear) {
      throw InputError(table_.name +
                       ": its scene has gravity that slopes; expected one whose gravity jumps at most");
    }
    gather();
    setDuration();
    run_.tracks.resize(bodies().size());
    for (std::size_t body = 0; body < bodies().size(); ++body) {
      if (isImmovable(bodies()[body].mass)) {
        checkFixed(body);
        run_.tracks[body].segments = {{.start = 0, .motion = Rest{bodies()[body].initial.pose}}};
      } else {
        addMotions(body, samplesOf(body));
      }
    }
    try {
      checkRun(run_);
    } catch (const InputError& error) {
      throw InputError(table_.name + ": with its scene, " + error.what());
    }
    return std::move(run_);
  }

 private:
  std::vector<Body>& bodies() { return run_.world.bodies; }

  void gather();
  std::size_t bodyOf(const PoseRow& row);
  void setDuration();
  void checkFixed(std::size_t body);
  Samples samplesOf(std::size_t body);
  void addMotions(std::size_t body, const Samples& samples);

  const PoseTable& table_;
  Trajectory run_;
  std::vector<std::vector<const PoseRow*>> rows_;  // of each body
};

std::size_t Giving::bodyOf(const PoseRow& row) {
  if (!table_.hasBoxes) {
    const auto canMove = [](const Body& body) { return !isImmovable(body.mass); };
    if (std::count_if(bodies().begin(), bodies().end(), canMove) != 1) {
      table_.fail(row, "no column of boxes", "it, as the scene has other than one box that can move");
    }
    return static_cast<std::size_t>(std::find_if(bodies().begin(), bodies().end(), canMove) -
                                    bodies().begin());
  }
  const std::string& name = table_.boxes[row.box];
  const auto named = [this](std::string_view wanted) {
    return std::find_if(bodies().begin(), bodies().end(),
                        [&](const Body& body) { return body.name == wanted; });
  };
  auto found = named(name);
  if (found == bodies().end() && name.starts_with('\'')) {  // see csvCell()
    found = named(std::string_view(name).substr(1));
  }
  if (found == bodies().end()) {
    std::string known;
    constexpr std::size_t kMostNamed = 8;
    for (std::size_t i = 0; i < std::min(bodies().size(), kMostNamed); ++i) {
      known += (i == 0 ? "" : ", ") + bodies()[i].name;
    }
    table_.fail(row, "the unknown box '" + name + "'",
                "a box of the scene: " + known + (bodies().size() > kMostNamed ? ", …" : ""));
  }
  return static_cast<std::size_t>(found - bodies().begin());
}

void Giving::gather() {
  rows_.resize(bodies().size());
  std::vector<std::optional<std::size_t>> bodyOfBox(table_.boxes.size());
  for (const PoseRow& row : table_.rows) {
    std::optional<std::size_t>& body = bodyOfBox[row.box];
    if (!body) {
      body = bodyOf(row);
      if (!rows_[*body].empty()) {
        table_.fail(row, "box '" + bodies()[*body].name + "' under two names", "one");
      }
    }
    rows_[*body].push_back(&row);
  }
  for (std::size_t body = 0; body < bodies().size(); ++body) {
    if (rows_[body].empty() && !isImmovable(bodies()[body].mass)) {
      throw InputError(table_.name + ": found no rows of box '" + bodies()[body].name +
                       "', expected all boxes of the scene that can move");
    }
  }
}

void Giving::setDuration() {
  double duration = std::numeric_limits<double>::infinity();
  for (std::size_t body = 0; body < bodies().size(); ++body) {
    if (!isImmovable(bodies()[body].mass)) {
      const PoseRow& last = *rows_[body].back();
      if (last.time <= 0) {
        table_.fail(last, "no row of box '" + bodies()[body].name + "' after 0 s", "a run that lasts");
      }
      duration = std::min(duration, last.time);
    }
  }
  if (!std::isfinite(duration)) {
    throw InputError(table_.name +
                     ": found a scene without a box that can move, expected one that has a run");
  }
  run_.settings.duration = duration;
}

void Giving::checkFixed(std::size_t body) {
  const Body& fixed = bodies()[body];
  for (const PoseRow* const row : rows_[body]) {
    const Pose pose{.position = row->position, .worldFromBody = row->worldFromBody.toRotationMatrix()};
    const PoseDifference moved =
        differenceOf(pose, boxPose(fixed, fixed.initial.pose), fixed.halfExtents.norm());
    if (!(moved.relative <= kGivenPlace)) {
      table_.fail(*row,
                  "the fixed box '" + fixed.name + "' " + brief(moved.position) + " m and " +
                      brief(moved.angle) + " rad away from where the scene has it",
                  "it there");
    }
  }
}

Samples Giving::samplesOf(std::size_t body) {
  const MassProperties& mass = bodies()[body].mass;
  const BodyState& initial = bodies()[body].initial;
  const std::vector<const PoseRow*>& rows = rows_[body];
  Samples samples;
  std::vector<Vec3> positions;
  std::vector<Quat> attitudes;
  std::vector<Vec3> angularVelocities;
  const auto add = [&](double time, const BodyState& state, const Vec3& spin) {
    samples.times.push_back(time);
    samples.states.push_back(state);
    positions.push_back(boxPose(bodies()[body], state.pose).position);
    attitudes.emplace_back(state.pose.worldFromBody);
    angularVelocities.push_back(spin);
  };
  if (rows.front()->time > 0) {
    add(0, initial, angularVelocity(mass, initial));
  }
  for (const PoseRow* const row : rows) {
    const Pose box{.position = row->position, .worldFromBody = row->worldFromBody.toRotationMatrix()};
    add(row->time, {.pose = bodyPose(bodies()[body], box), .velocity = row->velocity}, row->angularVelocity);
  }
  const std::vector<Vec3> velocities =
      table_.hasVelocities ? std::vector<Vec3>() : estimatedRates(samples.times, positions);
  if (!table_.hasAngularVelocities) {
    angularVelocities = estimatedAngularVelocities(samples.times, attitudes);
  }
  for (std::size_t k = 0; k < samples.states.size(); ++k) {
    BodyState& state = samples.states[k];
    if (!table_.hasVelocities) {
      state.velocity = velocities[k];
    }
    if (k > 0 || !(rows.front()->time > 0) || !table_.hasVelocities) {  // else of the scene, not of a row
      state.velocity =
          bodyVelocity(bodies()[body], state.pose.worldFromBody, state.velocity, angularVelocities[k]);
    }
    state.angularMomentum = angularMomentum(mass, state.pose.worldFromBody, angularVelocities[k]);
  }
  return samples;
}

void Giving::addMotions(std::size_t body, const Samples& samples) {
  bodies()[body].initial = samples.states.front();
  std::vector<Segment>& segments = run_.tracks[body].segments.open();
  for (std::size_t k = 0; k + 1 < samples.times.size() && samples.times[k] < run_.settings.duration; ++k) {
    segments.push_back({.start = samples.times[k],
                        .motion = SampledStep{.duration = samples.times[k + 1] - samples.times[k],
                                              .start = samples.states[k],
                                              .end = samples.states[k + 1]}});
  }
}

}  // namespace

std::vector<Vec3> estimatedRates(std::span<const double> times, std::span<const Vec3> values) {
  std::vector<Vec3> rates;
  for (std::size_t k = 0; k < times.size(); ++k) {
    rates.push_back(rateAt(times, k, [&](std::size_t j) { return values[j]; }));
  }
  return rates;
}

std::vector<Vec3> estimatedAngularVelocities(std::span<const double> times, std::span<const Quat> attitudes) {
  std::vector<Quat> continuous(attitudes.begin(), attitudes.end());
  for (std::size_t k = 1; k < continuous.size(); ++k) {
    if (dot(continuous[k], continuous[k - 1]) < 0) {
      continuous[k].coeffs() = -continuous[k].coeffs();
    }
  }
  std::vector<Vec3> rates;
  for (std::size_t k = 0; k < times.size(); ++k) {
    // Rotation vectors from the attitude at k: where they vanish, their rate is the angular velocity.
    rates.push_back(rateAt(
        times, k, [&](std::size_t j) { return rotationVector(continuous[j] * continuous[k].conjugate()); }));
  }
  return rates;
}

Trajectory givenRun(RunSetup setup, const PoseTable& table) { return Giving(std::move(setup), table).run(); }

}  // namespace careen
