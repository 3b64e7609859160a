#include "audit/samples.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <variant>

#include "core/error.h"

namespace careen {
namespace {

constexpr std::size_t kBetweenLooks = 1024;  // states, until asked again whether to stop

Vec3 centerIn(const Rest& rest, double /*elapsed*/) { return rest.pose.position; }
Vec3 centerIn(const EulerStep& step, double elapsed) {
  return step.start.pose.position + elapsed * step.start.velocity;
}
Vec3 centerIn(const Flight& flight, double elapsed) { return flight.positionAt(elapsed); }
Vec3 centerIn(const SteppedFlight& stepped, double elapsed) { return stepped.start.positionAt(elapsed); }
Vec3 centerIn(const ContactStep& step, double elapsed) { return positionAt(step, elapsed); }
Vec3 centerIn(const CrowdStep& step, double elapsed) { return positionAt(asContactStep(step), elapsed); }
Vec3 centerIn(const SampledStep& step, double elapsed) {
  // The mass matters only for the attitude.
  return stateAt(step, immovable(), elapsed).pose.position;
}

Vec3 centerIn(const Driven& driven, double elapsed) { return driven.at(elapsed).pose.position; }

bool areFinite(const Pose& pose) { return pose.position.allFinite() && pose.worldFromBody.allFinite(); }
bool areFinite(const Flight& flight) {
  return flight.position.allFinite() && flight.velocity.allFinite() && flight.acceleration.allFinite() &&
         flight.jerk.allFinite() && flight.worldFromBody.coeffs().allFinite() &&
         flight.angularMomentum.allFinite();
}

bool areFinite(const BodyState& state) {
  return areFinite(state.pose) && state.velocity.allFinite() && state.angularMomentum.allFinite();
}

struct AllFinite {
  bool operator()(const Rest& rest) const { return areFinite(rest.pose); }
  bool operator()(const EulerStep& step) const {
    return areFinite(step.start) && step.force.allFinite() && step.torque.allFinite();
  }
  bool operator()(const Flight& flight) const { return areFinite(flight); }
  bool operator()(const SteppedFlight& stepped) const { return areFinite(stepped.start); }
  bool operator()(const CrowdStep& step) const { return (*this)(asContactStep(step)); }
  bool operator()(const ContactStep& step) const {
    const auto finite = [](const auto& vector) { return vector.allFinite(); };
    return std::all_of(step.position.begin(), step.position.end(), finite) &&
           std::all_of(step.worldFromBody.begin(), step.worldFromBody.end(), finite);
  }
  bool operator()(const SampledStep& step) const { return areFinite(step.start) && areFinite(step.end); }
  bool operator()(const Driven& driven) const { return areFinite(stateOf(driven.at(0))); }
};

}  // namespace

Samples::Samples(const Trajectory& run, std::vector<double> times, const std::stop_token& stop)
    : bodies_(run.tracks.size()), times_(std::move(times)), states_(times_.size() * bodies_) {
  std::size_t done = 0;
  for (std::size_t body = 0; body < bodies_; ++body) {
    const Segments& segments = run.tracks[body].segments;
    std::size_t k = 0;
    for (std::size_t moment = 0; moment < times_.size(); ++moment) {
      while (k + 1 < segments.size() && segments[k + 1].start <= times_[moment]) {
        ++k;
      }
      states_[moment * bodies_ + body] =
          stateAt(segments[k].motion, run.world.bodies[body].mass, times_[moment] - segments[k].start);
      if (++done % kBetweenLooks == 0 && stop.stop_requested()) {
        throw Interrupted();
      }
    }
  }
}

Vec3 centerAt(const Motion& motion, double elapsed) {
  return std::visit([elapsed](const auto& kind) { return centerIn(kind, elapsed); }, motion);
}

std::size_t segmentAt(const Track& track, double time) {
  const std::size_t begun = track.segments.countUntil(time);
  return begun == 0 ? 0 : begun - 1;
}

std::vector<double> crowdBeginnings(const Trajectory& run) {
  std::vector<double> beginnings(run.tracks.size(), std::numeric_limits<double>::infinity());
  for (std::size_t body = 0; body < run.tracks.size(); ++body) {
    const Segments& segments = run.tracks[body].segments;
    const auto first = std::find_if(segments.begin(), segments.end(), [](const Segment& segment) {
      return std::holds_alternative<CrowdStep>(segment.motion);
    });
    beginnings[body] = run.given ? 0 : first != segments.end() ? first->start : beginnings[body];
  }
  return beginnings;
}

bool isFinite(const Motion& motion) { return std::visit(AllFinite{}, motion); }

bool mayTouch(const Motion& motion) {
  return std::holds_alternative<Rest>(motion) || std::holds_alternative<ContactStep>(motion) ||
         std::holds_alternative<CrowdStep>(motion) || std::holds_alternative<SampledStep>(motion);
}

}  // namespace careen
