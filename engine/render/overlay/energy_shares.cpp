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

Vec3 endOf(const SpringEnd& end, std::span<const BodyState> states) {
  return end.body ? states[static_cast<std::size_t>(*end.body)].pose.worldPoint(end.point) : end.point;
}

}  // namespace

std::vector<BodyState> statesAt(const Trajectory& trajectory, double time) {
  std::vector<BodyState> states;
  states.reserve(trajectory.tracks.size());
  for (std::size_t body = 0; body < trajectory.tracks.size(); ++body) {
    states.push_back(trajectory.state(body, time));
  }
  return states;
}

EnergyBook::EnergyBook(const Trajectory& trajectory)
    : gravity_(trajectory.world.gravity), springs_(trajectory.world.springs) {
  for (std::size_t body = 0; body < trajectory.tracks.size(); ++body) {
    masses_.push_back(trajectory.world.bodies[body].mass);
    lowest_.push_back(lowestOf(trajectory, body, gravity_));
  }
  atStart_ = sharesOf(statesAt(trajectory, 0)).sum();
  largest_ = atStart_;
  for (int sample = 1; sample <= kSamples; ++sample) {
    const double time = trajectory.settings.duration * sample / kSamples;
    largest_ = std::max(largest_, sharesOf(statesAt(trajectory, time)).sum());
  }
}

EnergyShares EnergyBook::sharesOf(std::span<const BodyState> states) const {
  EnergyShares shares;
  for (std::size_t body = 0; body < states.size(); ++body) {
    const MassProperties& mass = masses_[body];
    const BodyState& state = states[body];
    shares.translation += 0.5 * mass.mass * state.velocity.squaredNorm();
    shares.rotation += 0.5 * angularVelocity(mass, state).dot(state.angularMomentum);
    shares.potential += mass.mass * (-gravity_.dot(state.pose.position) - lowest_[body]);
  }
  for (const Spring& spring : springs_) {
    const double stretch = (endOf(spring.to, states) - endOf(spring.from, states)).norm() - spring.restLength;
    shares.springs += 0.5 * spring.stiffness * stretch * stretch;
  }
  return shares;
}

}  // namespace careen
