#include "physics/world/forces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/math/order_free_sum.h"
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

using Six = std::array<double, 6>;  // force and torque

struct SpringLoad {
  std::size_t body = 0;
  Six load{};
};

void addAt(const SpringEnd& end, const Vec3& point, const Vec3& force, std::span<const BodyState> states,
           std::vector<SpringLoad>& loads) {
  if (end.body) {
    const auto body = static_cast<std::size_t>(*end.body);
    const Vec3 torque = torqueAbout(point - states[body].pose.position, force);
    loads.push_back({body, {force[0], force[1], force[2], torque[0], torque[1], torque[2]}});
  }
}

// The order in which springs are listed changes no bit.
void addSprings(const World& world, std::span<const BodyState> states, std::vector<Load>& loads) {
  std::vector<SpringLoad> parts;
  parts.reserve(2 * world.springs.size());
  for (const Spring& spring : world.springs) {
    const Stretch stretch = stretchOf(spring, world, states);
    const Vec3 force = springForce(spring, stretch) * stretch.direction;
    addAt(spring.from, stretch.from, force, states, parts);
    addAt(spring.to, stretch.to, -force, states, parts);
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const SpringLoad& x, const SpringLoad& y) { return x.body < y.body; });
  std::vector<Six> ofBody;
  for (auto begin = parts.begin(); begin != parts.end();) {
    const std::size_t body = begin->body;
    ofBody.clear();
    for (; begin != parts.end() && begin->body == body; ++begin) {
      ofBody.push_back(begin->load);
    }
    const Six sum = orderFreeSums<6>(ofBody);
    loads[body].force += Vec3(sum[0], sum[1], sum[2]);
    loads[body].torque += Vec3(sum[3], sum[4], sum[5]);
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
    stretch.rate = dot(stretch.direction, to.velocity - from.velocity);
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
      power += dot(drag.force, states[i].velocity) + dot(drag.torque, omega);
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
  if (!world.springs.empty()) {
    addSprings(world, states, loads);
  }
}

std::vector<double> pulls(const World& world, std::span<const BodyState> states) {
  std::vector<double> pulls(states.size(), 0.0);
  for (const Spring& spring : world.springs) {
    const Stretch stretch = stretchOf(spring, world, states);
    for (const SpringEnd* end : {&spring.from, &spring.to}) {
      if (end->body) {
        const auto body = static_cast<std::size_t>(*end->body);
        const double inverseMass = world.bodies[body].mass.inverseMass;
        pulls[body] +=
            inverseMass * std::fabs(springForce(spring, stretch)) +
            std::sqrt(inverseMass * spring.stiffness) * motionOf(*end, world, states).velocity.norm();
      }
    }
  }
  const double gravity = world.gravity.norm();
  for (double& pull : pulls) {
    pull = std::max(pull, gravity);
  }
  return pulls;
}

std::vector<double> accelerationsAtStart(const World& world) {
  std::vector<BodyState> states;
  for (const Body& body : world.bodies) {
    states.push_back(body.initial);
  }
  std::vector<Load> loads;
  computeLoads(world, states, loads);
  std::vector<double> accelerations;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    accelerations.push_back(world.bodies[i].mass.inverseMass * loads[i].force.norm());
  }
  return accelerations;
}

}  // namespace careen
