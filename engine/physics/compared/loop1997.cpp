#include "physics/compared/loop1997.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.h"
#include "physics/compared/collision1997.h"
#include "physics/motion/listing1.h"
#include "physics/world/diagnostics.h"
#include "physics/world/run_settings.h"

namespace careen {
namespace {

constexpr double kShortestStep = 1e-5;  // [s] as in the sample
constexpr int kMostImpulses = 100;      // at one time, as in the sample
constexpr double kSliver = 1e-6;        // [1] of dt: a shorter last step is merged with the one before

class Loop1997 {
 public:
  Loop1997(const World& world, const RunSettings& settings, Recorder& recorder, const std::stop_token& stop);
  RunFigures run();

 private:
  void advanceTo(double end);
  void integrate(double h);
  double halved(double target, const CornerCheck& found) const;
  void resolve(CornerCheck found, double time);
  void record(double time);

  double stepEnd(std::int64_t step) const;
  bool fixed(std::size_t body) const { return isImmovable(world_.bodies[body].mass); }
  std::string where(double time, const CornerAtWall& corner) const;

  const World& world_;
  const RunSettings& settings_;
  Recorder& recorder_;
  const std::stop_token& stop_;

  double time_ = 0;
  std::vector<BodyState> now_;
  std::vector<BodyState> next_;
  std::vector<Load> loads_;
  RunAccount account_;
};

std::vector<BodyState> initialStates(const World& world) {
  std::vector<BodyState> states;
  states.reserve(world.bodies.size());
  for (const Body& body : world.bodies) {
    states.push_back(isImmovable(body.mass) ? BodyState{.pose = body.initial.pose} : body.initial);
  }
  return states;
}

std::string inSeconds(double time) {
  std::ostringstream text;
  text << time << " s";
  return text.str();
}

Loop1997::Loop1997(const World& world, const RunSettings& settings, Recorder& recorder,
                   const std::stop_token& stop)
    : world_(world),
      settings_(settings),
      recorder_(recorder),
      stop_(stop),
      now_(initialStates(world)),
      next_(now_),
      account_(world, now_) {}

// The whole method, up to resolve().

RunFigures Loop1997::run() {
  const CornerCheck start = checkCorners(world_, now_);
  if (start.state == CornerState::kPenetrating) {
    throw NumericalError(where(0, start.corner) + "the run cannot start from there; move the box out");
  }
  account_.reached(now_, start.deepest);
  for (std::size_t i = 0; i < now_.size(); ++i) {
    if (fixed(i)) {
      recorder_.moves(BodyIndex{static_cast<int>(i)}, 0, Rest{now_[i].pose});
    }
  }
  for (std::int64_t step = 1; time_ < settings_.duration; ++step) {
    advanceTo(stepEnd(step));
  }
  computeLoads(world_, world_.gravity, now_, loads_);
  record(time_);
  return account_.figures();
}

void Loop1997::advanceTo(double end) {
  double target = end;
  while (time_ < end) {
    if (stop_.stop_requested()) {
      throw Interrupted();
    }
    recorder_.reaches(time_);
    computeLoads(world_, world_.gravity, now_, loads_);
    integrate(target - time_);
    const CornerCheck found = checkCorners(world_, next_);
    if (found.state == CornerState::kPenetrating) {
      target = halved(target, found);
      continue;
    }
    record(time_);
    account_.moved(now_, next_, loads_, target - time_);
    resolve(found, target);
    account_.reached(next_, found.deepest);
    now_.swap(next_);
    time_ = target;
    target = end;
  }
}

// An impulse does not change positions, so a check after it never finds deeper penetration than before.
void Loop1997::resolve(CornerCheck found, double time) {
  for (int impulses = 0; found.state == CornerState::kColliding; ++impulses) {
    if (impulses == kMostImpulses) {
      throw NumericalError(
          where(time, found.corner) + "still approaching after " + std::to_string(kMostImpulses) +
          " impulses at one moment; the 1997 method cannot let a box rest: more restitution or a "
          "shorter run may avoid it");
    }
    const ResolvedCorner resolved = resolveCorner(world_, found.corner, time, next_);
    account_.struck(resolved.energyChange);
    recorder_.strikes(resolved.impact);
    found = checkCorners(world_, next_);
  }
}

double Loop1997::halved(double target, const CornerCheck& found) const {
  const double half = (time_ + target) / 2;
  if (half - time_ <= kShortestStep) {
    throw NumericalError(
        where(time_, found.corner) + "every step longer than " + inSeconds(kShortestStep) +
        " penetrates that far; the 1997 method cannot let a box rest or roll on a wall: more "
        "restitution, a smaller dt or a shorter run may avoid it");
  }
  return half;
}

void Loop1997::integrate(double h) {
  for (std::size_t i = 0; i < now_.size(); ++i) {
    if (fixed(i)) {
      continue;
    }
    next_[i] = listing1Step(world_.bodies[i].mass, now_[i], loads_[i], h);
    if (!isFinite(next_[i])) {
      throw NumericalError("after " + inSeconds(time_) + " box " + world_.bodies[i].name +
                           ": its state is not finite; take a smaller dt or softer springs");
    }
  }
}

void Loop1997::record(double time) {
  for (std::size_t i = 0; i < now_.size(); ++i) {
    if (!fixed(i)) {
      recorder_.moves(BodyIndex{static_cast<int>(i)}, time,
                      EulerStep{.start = now_[i], .force = loads_[i].force, .torque = loads_[i].torque});
    }
  }
}

// By multiplication: a running sum would drift away from the video frames.
double Loop1997::stepEnd(std::int64_t step) const {
  const double end = static_cast<double>(step) * settings_.dt;
  return end < settings_.duration - kSliver * settings_.dt ? end : settings_.duration;
}

std::string Loop1997::where(double time, const CornerAtWall& corner) const {
  std::ostringstream text;
  text << "at " << inSeconds(time) << " box "
       << world_.bodies[static_cast<std::size_t>(corner.body.value)].name << " at wall "
       << world_.walls[corner.wall].name << ", its corner " << 1e3 * std::fabs(corner.gap) << " mm "
       << (corner.gap < 0 ? "behind" : "before") << " it: ";
  return text.str();
}

}  // namespace

RunFigures runLoop1997(const World& world, const RunSettings& settings, Recorder& recorder,
                       const std::stop_token& stop) {
  return Loop1997(world, settings, recorder, stop).run();
}

}  // namespace careen
