#include "physics/world/flight_account.h"

#include <algorithm>
#include <cmath>

#include "core/math/rotation.h"
#include "physics/world/forces.h"
#include "physics/world/run_settings.h"

namespace careen {

FlightAccount::FlightAccount(const World& world)
    : world_(world),
      bodies_(world.bodies.size()),
      mayGain_(hasBelts(world) || hasCourses(world) || world.gravityPath == GravityPath::kLinear) {
  if (!world.springs.empty() || !world.joints.empty()) {
    for (const Body& body : world.bodies) {
      states_.push_back(body.initial);
    }
  }
}

// Bodies joined by a spring are seen at the same times.
double FlightAccount::energy() const {
  return states_.empty() ? energy_ : energy_ + springEnergy(world_, states_);
}

void FlightAccount::see(std::size_t body, const BodyState& state) {
  const MassProperties& mass = world_.bodies[body].mass;
  BodyAccount& account = bodies_[body];
  const double kinetic = kineticEnergy(mass, state);
  const double energy = kinetic - mass.mass * dot(world_.gravity, state.pose.position);
  energy_ += energy - account.energy;
  kinetic_ += kinetic - account.kinetic;
  account.energy = energy;
  account.kinetic = kinetic;
  largestKinetic_ = std::max(largestKinetic_, kinetic_);
  if (!states_.empty()) {
    states_[body] = state;
  }
  orthogonality_ = std::max(orthogonality_, orthogonalityError(state.pose.worldFromBody));
}

void FlightAccount::departs(std::size_t body, const BodyState& state) {
  see(body, state);
  bodies_[body].momentum = world_.bodies[body].mass.mass * state.velocity;
  bodies_[body].angularMomentum = state.angularMomentum;
}

void FlightAccount::passes(std::size_t body, const BodyState& state) {
  see(body, state);
  largestError_ = std::max(largestError_, std::abs(energy() - due_));
}

void FlightAccount::arrives(std::size_t body, const BodyState& state, double elapsed, const Vec3& more) {
  passes(body, state);
  const BodyAccount& begun = bodies_[body];
  const double mass = world_.bodies[body].mass.mass;
  const Vec3 due = begun.momentum + elapsed * mass * (world_.gravity + more);
  expect(mass * state.velocity, due, 0);
  // A box that hardly turns has an angular momentum of rounding.
  expect(state.angularMomentum, begun.angularMomentum, world_.bodies[body].halfExtents.norm() * due.norm());
}

void FlightAccount::expect(const Vec3& momentum, const Vec3& due, double least) {
  const double size = std::max({momentum.norm(), due.norm(), least});
  if (size > 0) {
    momentumError_ = std::max(momentumError_, (momentum - due).norm() / size);
  }
}

void FlightAccount::parted() {
  const double energy = this->energy();
  if (!begun_ || mayGain_ || (mayLose_ && energy < due_)) {
    due_ = energy;
  }
  begun_ = true;
  mayLose_ = false;
  largestError_ = std::max(largestError_, std::abs(energy - due_));
}

void FlightAccount::penetrates(double depth) { deepest_ = std::max(deepest_, depth); }

RunFigures FlightAccount::figures() const {
  return {.energyChange = largestKinetic_ > 0 ? largestError_ / largestKinetic_ : 0,
          .momentumChange = momentumError_,
          .orthogonality = orthogonality_,
          .deepestPenetration = deepest_,
          .boundedFrom = boundedFrom_,
          .horizon = horizon_,
          .contact = contact_,
          .crowds = crowds_};
}

}  // namespace careen
