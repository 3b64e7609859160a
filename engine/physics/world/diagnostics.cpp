#include "physics/world/diagnostics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/math/rotation.h"
#include "physics/world/run_settings.h"

namespace careen {
namespace {

bool hasDissipation(const World& world) {
  return world.drag.has_value() || std::any_of(world.springs.begin(), world.springs.end(),
                                               [](const Spring& spring) { return spring.damping != 0; });
}

}  // namespace

Energy energyOf(const World& world, std::span<const BodyState> states) {
  Energy energy;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const MassProperties& mass = world.bodies[i].mass;
    const BodyState& state = states[i];
    energy.kinetic += kineticEnergy(mass, state);
    energy.gravitational -= mass.mass * dot(world.gravity, state.pose.position);
  }
  energy.springs = springEnergy(world, states);
  return energy;
}

bool isFinite(const BodyState& state) {
  return state.pose.position.allFinite() && state.pose.worldFromBody.allFinite() &&
         state.velocity.allFinite() && state.angularMomentum.allFinite();
}

Vec3 linearMomentum(const World& world, std::span<const BodyState> states) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < states.size(); ++i) {
    sum += world.bodies[i].mass.mass * states[i].velocity;
  }
  return sum;
}

RunAccount::RunAccount(const World& world, std::span<const BodyState> initial)
    : world_(world), dissipates_(hasDissipation(world)), bodies_(initial.size()) {
  const Energy energy = energyOf(world, initial);
  initialEnergy_ = energy.total();
  largestDueEnergy_ = energy.kinetic + energy.springs;
}

void RunAccount::MomentumAccount::add(const Vec3& before, const Vec3& after, const Vec3& given) {
  error += after - before - given;
  largestErrorSquared = std::max(largestErrorSquared, error.squaredNorm());
  largestSquared = std::max({largestSquared, before.squaredNorm(), after.squaredNorm()});
}

double RunAccount::MomentumAccount::relative() const {
  return largestSquared > 0 ? std::sqrt(largestErrorSquared / largestSquared) : 0;
}

void RunAccount::moved(std::span<const BodyState> before, std::span<const BodyState> after,
                       std::span<const Load> loads, double h) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const MassProperties& mass = world_.bodies[i].mass;
    if (isImmovable(mass)) {
      continue;
    }
    bodies_[i].linear.add(mass.mass * before[i].velocity, mass.mass * after[i].velocity, h * loads[i].force);
    bodies_[i].angular.add(before[i].angularMomentum, after[i].angularMomentum, h * loads[i].torque);
    orthogonality_ = std::max(orthogonality_, orthogonalityError(after[i].pose.worldFromBody));
  }
  if (dissipates_) {
    accounted_ += 0.5 * h * (dissipation(world_, before) + dissipation(world_, after));
  }
}

void RunAccount::reached(std::span<const BodyState> states, double deepest) {
  const Energy energy = energyOf(world_, states);
  const double error = energy.total() - initialEnergy_ - accounted_;
  largestEnergyError_ = std::max(largestEnergyError_, std::fabs(error));
  largestDueEnergy_ = std::max(largestDueEnergy_, energy.kinetic + energy.springs - error);
  deepest_ = std::max(deepest_, deepest);
}

RunFigures RunAccount::figures() const {
  RunFigures figures;
  if (largestDueEnergy_ > 0) {
    figures.energyChange = largestEnergyError_ / largestDueEnergy_;
  }
  for (const BodyAccount& body : bodies_) {
    figures.momentumChange =
        std::max({figures.momentumChange, body.linear.relative(), body.angular.relative()});
  }
  figures.orthogonality = orthogonality_;
  figures.deepestPenetration = deepest_;
  return figures;
}

}  // namespace careen
