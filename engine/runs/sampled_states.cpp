#include "runs/sampled_states.h"

#include <limits>
#include <utility>

namespace careen {

SampledStates::SampledStates(const World& world, std::span<const double> times)
    : world_(world),
      times_(times),
      tracks_(world.bodies.size()),
      states_(times.size(), std::vector<BodyState>(world.bodies.size())) {}

void SampledStates::moves(BodyIndex body, double time, const Motion& motion) {
  const auto index = static_cast<std::size_t>(body.value);
  sampleBefore(index, time);
  tracks_[index].start = time;
  tracks_[index].motion = motion;
}

std::vector<std::vector<BodyState>> SampledStates::finish() {
  for (std::size_t body = 0; body < tracks_.size(); ++body) {
    sampleBefore(body, std::numeric_limits<double>::infinity());
  }
  return std::move(states_);
}

// At the time where two motions meet, the later one counts.
void SampledStates::sampleBefore(std::size_t body, double time) {
  Track& track = tracks_[body];
  for (; track.sampled < times_.size() && times_[track.sampled] < time; ++track.sampled) {
    states_[track.sampled][body] =
        stateAt(track.motion, world_.bodies[body].mass, times_[track.sampled] - track.start);
  }
}

}  // namespace careen
