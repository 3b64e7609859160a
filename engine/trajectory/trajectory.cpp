#include "trajectory/trajectory.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "core/brief.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/names.h"
#include "physics/simulate.h"
#include "physics/world/diagnostics.h"
#include "physics/world/method.h"
#include "physics/world/run_settings.h"
#include "trajectory/run_check.h"

namespace careen {
namespace {

class TrajectoryRecorder : public Recorder {
 public:
  TrajectoryRecorder(Trajectory& trajectory, std::uint64_t most, const EnoughRecorded& isEnough)
      : trajectory_(trajectory), most_(most) {
    if (trajectory.settings.method == Method::kExact) {
      isEnough_ = isEnough;
    }
  }

  void moves(BodyIndex body, double time, const Motion& motion) override {
    count(time);
    trajectory_.tracks.at(static_cast<std::size_t>(body.value))
        .segments.addPacked({.start = time, .motion = motion});
  }
  void strikes(const Impact& impact) override {
    count(impact.time);
    insertByTime(trajectory_.impacts, impact);
  }
  void passes(const JointImpulse& impulse) override {
    count(impulse.time);
    insertByTime(trajectory_.jointImpulses, impulse);
  }
  void drives(const JointEffort& effort) override {
    count(effort.time);
    insertByTime(trajectory_.jointEfforts, effort);
  }
  void reaches(double time) override {
    reached_ = time;
    hasEnough_ = isEnough_ && isEnough_(trajectory_, time);
  }
  bool hasEnough() const override { return hasEnough_; }
  double reached() const { return reached_; }  // [s]

 private:
  void count(double time) {
    if (++count_ > most_) {
      throw InputError("the run takes more than " + std::to_string(most_) +
                       " pieces of motion and impacts, at " + brief(time) + " s of " +
                       brief(trajectory_.settings.duration) +
                       " s; expected a shorter run, longer steps, or a higher --limit");
    }
  }

  Trajectory& trajectory_;
  const std::uint64_t most_;
  EnoughRecorded isEnough_;
  std::uint64_t count_ = 0;
  double reached_ = 0;
  bool hasEnough_ = false;
};

// Sizes, masses and speeds far from 1 may underflow or overflow in between: no such run may end as if it were
// a right one.
void checkFinite(const Trajectory& run) {
  for (std::size_t body = 0; body < run.tracks.size(); ++body) {
    const Body& moved = run.world.bodies[body];
    const auto fail = [&moved](double time) {
      throw NumericalError("box " + moved.name + ": its state is not finite from " + brief(time) +
                           " s on; its size, mass or speed is beyond what the method can compute with");
    };
    for (const Segment& segment : run.tracks[body].segments) {
      if (!isFinite(stateAt(segment.motion, moved.mass, 0))) {
        fail(segment.start);
      }
    }
    if (!isFinite(run.state(body, run.settings.duration))) {
      fail(run.settings.duration);
    }
  }
}

// As whoever reads its file will.
void checkReadable(const Trajectory& run) {
  try {
    checkMotions(run);
  } catch (const InputError& error) {
    throw NumericalError(std::string("the run ") + error.what() + ", so its file could not be read");
  }
}

void add(Hash& hash, const BodyState& state) {
  for (const Vec3& vector : {state.pose.position, state.velocity, state.angularMomentum}) {
    for (int i = 0; i < 3; ++i) {
      hash.add(vector[i]);
    }
  }
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      hash.add(state.pose.worldFromBody(row, column));
    }
  }
}

}  // namespace

BodyState Trajectory::state(std::size_t body, double time) const {
  if (!(time >= 0 && time <= settings.duration)) {
    throw InputError("time " + std::to_string(time) + " s lies outside the run, which lasts from 0 to " +
                     std::to_string(settings.duration) + " s");
  }
  const Track& track = tracks.at(body);
  const Body& moved = world.bodies.at(body);
  const std::size_t begun = track.segments.countUntil(time);
  if (begun == 0) {
    throw InputError("body " + moved.name + " has no recorded motion");
  }
  const Segment segment = track.segments[begun - 1];
  return stateAt(segment.motion, moved.mass, time - segment.start);
}

std::vector<BodyState> Trajectory::states(double time) const {
  std::vector<BodyState> states;
  states.reserve(tracks.size());
  for (std::size_t body = 0; body < tracks.size(); ++body) {
    states.push_back(state(body, time));
  }
  return states;
}

Pose Trajectory::boxPoseAt(std::size_t body, double time) const {
  return boxPose(world.bodies.at(body), state(body, time).pose);
}

std::vector<Pose> Trajectory::poses(double time) const {
  std::vector<Pose> poses;
  poses.reserve(tracks.size());
  for (std::size_t body = 0; body < tracks.size(); ++body) {
    poses.push_back(boxPoseAt(body, time));
  }
  return poses;
}

const std::string& Trajectory::partnerName(const Impact& impact) const {
  return impact.b.isWall() ? world.walls.at(impact.b.wall()).name
                           : world.bodies.at(static_cast<std::size_t>(impact.b.body())).name;
}

std::string Trajectory::methodName() const {
  return given ? "given poses" : std::string(traitsOf(settings.method).name);
}

std::string Trajectory::sceneHash() const {
  Hash hash;
  hash.add(sceneText);
  return hash.text();
}

std::string Trajectory::stateHash() const {
  Hash hash;
  for (const std::size_t body : orderByName(world.bodies)) {
    add(hash, state(body, settings.duration));
  }
  return hash.text();
}

Trajectory record(RunSetup setup, const std::stop_token& stop, std::uint64_t most,
                  const RunCallback& progress, const EnoughRecorded& isEnough) {
  Trajectory trajectory;
  static_cast<RunSetup&>(trajectory) = std::move(setup);
  trajectory.tracks.resize(trajectory.world.bodies.size());
  TrajectoryRecorder recorder(trajectory, most, isEnough);
  trajectory.figures = simulate(trajectory.world, trajectory.settings, recorder, stop, progress);
  if (recorder.hasEnough()) {
    trajectory.settings.duration = recorder.reached();
  }
  checkFinite(trajectory);
  checkReadable(trajectory);
  return trajectory;
}

Trajectory record(const World& world, const RunSettings& settings, std::string sceneText,
                  const std::stop_token& stop) {
  RunSetup setup{
      .sceneText = std::move(sceneText), .settings = settings, .world = world, .stage = {}, .plan = {}};
  setup.stage.colors.resize(world.bodies.size());
  return record(std::move(setup), stop);
}

}  // namespace careen
