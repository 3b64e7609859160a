#include "physics/world/forces.h"

#include <cstddef>

#include "physics/world/kinematics.h"

namespace careen {
namespace {

struct EndMotion {
  Vec3 position;
  Vec3 velocity;
};

EndMotion motionOf(const SpringEnd& end, const World& world, std::span<const BodyState> states) {
  if (!end.body) {
    return {.position = end.point, .velocity = Vec3::Zero()};
  }
  const auto index = static_cast<std::size_t>(*end.body);
  const BodyState& state = states[index];
  const Vec3 r = state.pose.worldFromBody * end.point;
  const Vec3 omega = angularVelocity(world.bodies[index].mass, state);
  return {.position = state.pose.position + r, .velocity = pointVelocity(state.velocity, omega, r)};
}

void applyAt(const SpringEnd& end, const Vec3& point, const Vec3& force, std::span<const BodyState> states,
             std::vector<Load>& loads) {
  if (end.body) {
    const auto index = static_cast<std::size_t>(*end.body);
    loads[index].force += force;
    loads[index].torque += torqueAbout(point - states[index].pose.position, force);
  }
}

}  // namespace

Load dragLoad(const Drag& drag, const Vec3& velocity, const Vec3& angularVelocity) {
  return {.force = -drag.linear * velocity, .torque = -drag.angular * angularVelocity};
}

Stretch stretchOf(const Spring& spring, const World& world, std::span<const BodyState> states) {
  const EndMotion from = motionOf(spring.from, world, states);
  const EndMotion to = motionOf(spring.to, world, states);
  Stretch stretch{.from = from.position, .to = to.position};
  const Vec3 between = to.position - from.position;
  stretch.length = between.norm();
  if (stretch.length > 0) {
    stretch.direction = between / stretch.length;
    stretch.rate = stretch.direction.dot(to.velocity - from.velocity);
  }
  return stretch;
}

double springForce(const Spring& spring, const Stretch& stretch) {
  return spring.stiffness * (stretch.length - spring.restLength) + spring.damping * stretch.rate;
}

double springEnergy(const World& world, std::span<const BodyState> states) {
  double energy = 0;
  for (const Spring& spring : world.springs) {
    const double extension = stretchOf(spring, world, states).length - spring.restLength;
    energy += 0.5 * spring.stiffness * extension * extension;
  }
  return energy;
}

double dissipation(const World& world, std::span<const BodyState> states) {
  double power = 0;
  for (const Spring& spring : world.springs) {
    const double rate = stretchOf(spring, world, states).rate;
    power -= spring.damping * rate * rate;
  }
  if (world.drag) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Vec3 omega = angularVelocity(world.bodies[i].mass, states[i]);
      const Load drag = dragLoad(*world.drag, states[i].velocity, omega);
      power += drag.force.dot(states[i].velocity) + drag.torque.dot(omega);
    }
  }
  return power;
}

void computeLoads(const World& world, std::span<const BodyState> states, std::vector<Load>& loads) {
  loads.resize(states.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    loads[i] = {.force = world.bodies[i].mass.mass * world.gravity, .torque = Vec3::Zero()};
    if (world.drag) {
      const Vec3 omega = angularVelocity(world.bodies[i].mass, states[i]);
      const Load drag = dragLoad(*world.drag, states[i].velocity, omega);
      loads[i].force += drag.force;
      loads[i].torque += drag.torque;
    }
  }
  for (const Spring& spring : world.springs) {
    const Stretch stretch = stretchOf(spring, world, states);
    const Vec3 force = springForce(spring, stretch) * stretch.direction;
    applyAt(spring.from, stretch.from, force, states, loads);
    applyAt(spring.to, stretch.to, -force, states, loads);
  }
}

}  // namespace careen
