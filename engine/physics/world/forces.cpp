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

// A couple, or a force at the point of `from`, and its opposite on `to`.
void addJoint(const Joint& joint, const World& world, std::span<const BodyState> states,
              std::vector<SpringLoad>& loads) {
  const JointMotion motion = jointMotionOf(joint, world, states);
  const Vec3 along = jointForce(joint, motion) * motion.axis;
  const auto add = [&](const JointEnd& end, const Vec3& given) {
    if (joint.kind == Joint::Kind::kSlider) {
      addAt({.body = end.body}, motion.point, given, states, loads);
    } else if (end.body) {
      loads.push_back({static_cast<std::size_t>(*end.body), {0, 0, 0, given[0], given[1], given[2]}});
    }
  };
  add(joint.from, along);
  add(joint.to, -along);
}

// The order in which springs and joints are listed changes no bit.
void addSprings(const World& world, std::span<const BodyState> states, std::vector<Load>& loads) {
  std::vector<SpringLoad> parts;
  parts.reserve(2 * world.springs.size());
  for (const Spring& spring : world.springs) {
    const Stretch stretch = stretchOf(spring, world, states);
    const Vec3 force = springForce(spring, stretch) * stretch.direction;
    addAt(spring.from, stretch.from, force, states, parts);
    addAt(spring.to, stretch.to, -force, states, parts);
  }
  for (const Joint& joint : world.joints) {
    if (joint.isLoaded()) {
      addJoint(joint, world, states, parts);
    }
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

JointMotion jointMotionOf(const Joint& joint, const World& world, std::span<const BodyState> states) {
  const auto poseOf = [&](const JointEnd& end) {
    return end.body ? states[static_cast<std::size_t>(*end.body)].pose : Pose{};
  };
  const auto spinOf = [&](const JointEnd& end) {
    if (!end.body) {
      return Vec3(Vec3::Zero());
    }
    const auto index = static_cast<std::size_t>(*end.body);
    return angularVelocity(world.bodies[index].mass, states[index]);
  };
  const Pose from = poseOf(joint.from);
  const Pose to = poseOf(joint.to);
  JointMotion motion{.coordinate = jointCoordinate(joint, from, to),
                     .axis = joint.to.axesAt(to).col(2),
                     .point = joint.from.pointAt(from)};
  if (joint.kind == Joint::Kind::kSlider) {
    const auto velocityAt = [&](const JointEnd& end) {
      if (!end.body) {
        return Vec3(Vec3::Zero());
      }
      const BodyState& state = states[static_cast<std::size_t>(*end.body)];
      return pointVelocity(state.velocity, spinOf(end), motion.point - state.pose.position);
    };
    motion.rate = dot(motion.axis, Vec3(velocityAt(joint.from) - velocityAt(joint.to)));
  } else {
    motion.rate = dot(motion.axis, Vec3(spinOf(joint.from) - spinOf(joint.to)));
  }
  return motion;
}

double jointForce(const Joint& joint, const JointMotion& motion) {
  return joint.effort - joint.stiffness * (motion.coordinate - joint.rest) - joint.damping * motion.rate;
}

bool hasSprings(const World& world) {
  return !world.springs.empty() || std::any_of(world.joints.begin(), world.joints.end(),
                                               [](const Joint& joint) { return joint.isLoaded(); });
}

double springEnergy(const World& world, std::span<const BodyState> states) {
  double energy = 0;
  for (const Spring& spring : world.springs) {
    const double extension = stretchOf(spring, world, states).length - spring.restLength;
    energy += 0.5 * spring.stiffness * extension * extension;
  }
  for (const Joint& joint : world.joints) {
    if (joint.stiffness != 0) {
      const double extension = jointMotionOf(joint, world, states).coordinate - joint.rest;
      energy += 0.5 * joint.stiffness * extension * extension;
    }
  }
  return energy;
}

double dissipation(const World& world, std::span<const BodyState> states) {
  double power = 0;
  for (const Spring& spring : world.springs) {
    const double rate = stretchOf(spring, world, states).rate;
    power -= spring.damping * rate * rate;
  }
  for (const Joint& joint : world.joints) {
    if (joint.damping != 0) {
      const double rate = jointMotionOf(joint, world, states).rate;
      power -= joint.damping * rate * rate;
    }
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

void computeLoads(const World& world, const Vec3& gravity, std::span<const BodyState> states,
                  std::vector<Load>& loads) {
  loads.resize(states.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    loads[i] = {.force = world.bodies[i].mass.mass * gravity, .torque = Vec3::Zero()};
    if (world.drag) {
      const Vec3 omega = angularVelocity(world.bodies[i].mass, states[i]);
      const Load drag = dragLoad(*world.drag, states[i].velocity, omega);
      loads[i].force += drag.force;
      loads[i].torque += drag.torque;
    }
  }
  if (hasSprings(world)) {
    addSprings(world, states, loads);
  }
}

namespace {

// A torque counts by what it does at a corner.
void addPulls(const Joint& joint, const World& world, std::span<const BodyState> states,
              std::vector<double>& pulls) {
  const JointMotion motion = jointMotionOf(joint, world, states);
  const bool slides = joint.kind == Joint::Kind::kSlider;
  for (const JointEnd* end : {&joint.from, &joint.to}) {
    if (end->body) {
      const auto body = static_cast<std::size_t>(*end->body);
      const MassProperties& mass = world.bodies[body].mass;
      const double radius = slides ? 1 : radiusOf(world.bodies[body]);
      const double ease = slides ? mass.inverseMass : mass.inverseInertiaBody.maxCoeff();
      pulls[body] += radius * (ease * (std::fabs(jointForce(joint, motion)) + joint.grip) +
                               std::sqrt(ease * joint.stiffness) * std::fabs(motion.rate));
    }
  }
}

}  // namespace

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
  for (const Joint& joint : world.joints) {
    if (joint.isLoaded()) {
      addPulls(joint, world, states, pulls);
    }
  }
  const double gravity = gravityScale(world);
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
  computeLoads(world, world.gravity, states, loads);
  std::vector<double> accelerations;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    accelerations.push_back(world.bodies[i].mass.inverseMass * loads[i].force.norm());
  }
  for (const Joint& joint : world.joints) {
    if (joint.isLoaded()) {
      addPulls(joint, world, states, accelerations);
    }
  }
  return accelerations;
}

}  // namespace careen
