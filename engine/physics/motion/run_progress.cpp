#include "physics/motion/run_progress.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <variant>

namespace careen {
namespace {

constexpr double kTellEvery = 0.1;    // [s]
constexpr double kLookEvery = 0.005;  // [s] at the clock
/// An event takes a microsecond or a second, and to ask the clock at each would cost a hundredth of the quick
/// ones.
constexpr int kMostCallsOfLook = 16;

std::uint64_t RunProgress::*countOf(const Motion& motion) {
  if (std::holds_alternative<Rest>(motion)) {
    return &RunProgress::resting;
  }
  return std::holds_alternative<ContactStep>(motion) || std::holds_alternative<CrowdStep>(motion)
             ? &RunProgress::touching
             : &RunProgress::flying;
}

}  // namespace

void RunForecast::add(const RunMark& mark) {
  now_ = mark;
  if (now_.wallSeconds >= 2 * middle_.wallSeconds) {
    from_ = middle_;
    middle_ = now_;
  }
}

double RunForecast::perSimulated(double amount) const {
  return now_.time > from_.time ? amount / (now_.time - from_.time) : 0;
}

std::optional<double> RunForecast::secondsUntil(double time) const {
  if (!(now_.time > from_.time)) {
    return std::nullopt;
  }
  return perSimulated(now_.wallSeconds - from_.wallSeconds) * (time - now_.time);
}

double RunForecast::recordsAt(double time) const {
  return static_cast<double>(now_.records) +
         perSimulated(static_cast<double>(now_.records - from_.records)) * (time - now_.time);
}

double RunForecast::timeOf(double records) const {
  const double rate = perSimulated(static_cast<double>(now_.records - from_.records));
  return rate > 0 ? now_.time + (records - static_cast<double>(now_.records)) / rate
                  : std::numeric_limits<double>::infinity();
}

bool RunForecast::exceeds(std::uint64_t most, double time) const {
  const auto records = static_cast<double>(now_.records);
  const auto allowed = static_cast<double>(most);
  return records >= 0.1 * allowed && recordsAt(time) - records > 2 * (allowed - records);
}

ProgressRecorder::ProgressRecorder(const World& world, double duration, Recorder& next,
                                   const RunCallback& tell)
    : next_(next), tell_(tell), countedIn_(world.bodies.size(), nullptr) {
  progress_.duration = duration;
  for (const Body& body : world.bodies) {
    fixed_.push_back(isImmovable(body.mass) ? 1 : 0);
  }
}

void ProgressRecorder::moves(BodyIndex body, double time, const Motion& motion) {
  ++progress_.now.records;
  const auto at = static_cast<std::size_t>(body.value);
  if (fixed_[at] == 0) {
    if (countedIn_[at] != nullptr) {
      --(progress_.*countedIn_[at]);
    }
    countedIn_[at] = countOf(motion);
    ++(progress_.*countedIn_[at]);
  }
  next_.moves(body, time, motion);
}

void ProgressRecorder::strikes(const Impact& impact) {
  ++progress_.now.records;
  ++progress_.impacts;
  next_.strikes(impact);
}

void ProgressRecorder::reaches(double time) {
  next_.reaches(time);
  if (++calls_ >= callsOfLook_) {
    look(time);
  }
}

void ProgressRecorder::look(double time) {
  const double now = secondsSince(begun_);
  callsOfLook_ = now - lookedAt_ < kLookEvery ? std::min(2 * callsOfLook_, kMostCallsOfLook) : 1;
  calls_ = 0;
  lookedAt_ = now;
  if (now - toldAt_ < kTellEvery) {
    return;
  }
  toldAt_ = now;
  progress_.now.wallSeconds = now;
  progress_.now.time = time;
  progress_.forecast.add(progress_.now);
  tell_(progress_);
}

void ProgressRecorder::finish() {
  progress_.now.wallSeconds = secondsSince(begun_);
  progress_.now.time = progress_.duration;
  progress_.isOver = true;
  progress_.forecast.add(progress_.now);
  tell_(progress_);
}

}  // namespace careen
