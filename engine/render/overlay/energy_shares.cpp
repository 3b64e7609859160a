#include "render/overlay/energy_shares.h"

#include <algorithm>
#include <cmath>

namespace careen {
namespace {

constexpr int kSamples = 256;  // of the run, to find the largest energy sum

// Minimum of −g·x of a box's centre over the run.
double lowestOf(const Trajectory& trajectory, std::size_t body, const Vec3& gravity) {
  double lowest = -gravity.dot(trajectory.state(body, trajectory.settings.duration).pose.position);
  for (const Segment& segment : trajectory.tracks[body].segments) {
    if (segment.start <= trajectory.settings.duration) {
      const BodyState state = stateAt(segment.motion, trajectory.world.bodies[body].mass, 0);
      lowest = std::min(lowest, -gravity.dot(state.pose.position));
    }
  }
  return lowest;
}

}  // namespace

EnergyBook::EnergyBook(const Trajectory& trajectory) : world_(trajectory.world) {
  std::vector<Vec3> gravities{world_.gravity};
  for (const GravityChange& change : world_.gravityChanges) {
    gravities.push_back(change.gravity);
  }
  for (const Vec3& gravity : gravities) {
    double& lowest = lowest_.emplace_back();
    for (std::size_t body = 0; body < trajectory.tracks.size(); ++body) {
      lowest += world_.bodies[body].mass.mass * lowestOf(trajectory, body, gravity);
    }
  }
  hasSprings_ =
      !world_.springs.empty() || std::any_of(world_.joints.begin(), world_.joints.end(),
                                             [](const Joint& joint) { return joint.stiffness != 0; });
  atStart_ = sharesOf(trajectory.states(0), 0).sum();
  largest_ = atStart_;
  for (int sample = 1; sample <= kSamples; ++sample) {
    const double time = trajectory.settings.duration * sample / kSamples;
    largest_ = std::max(largest_, sharesOf(trajectory.states(time), time).sum());
  }
}

EnergyShares EnergyBook::sharesOf(std::span<const BodyState> states, double time) const {
  EnergyShares shares = energySharesOf(world_, states, time);
  const auto changed = std::count_if(world_.gravityChanges.begin(), world_.gravityChanges.end(),
                                     [&](const GravityChange& change) { return change.time <= time; });
  const auto last = static_cast<std::size_t>(changed);
  shares.gravity -= lowest_[last];
  if (world_.gravityPath == GravityPath::kLinear && last < world_.gravityChanges.size()) {
    // The lowest is concave in gravity: between two it is not below what is between theirs.
    const double from = last == 0 ? world_.gravitySince : world_.gravityChanges[last - 1].time;
    shares.gravity -=
        (time - from) / (world_.gravityChanges[last].time - from) * (lowest_[last + 1] - lowest_[last]);
  }
  return shares;
}

}  // namespace careen
