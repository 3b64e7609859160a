#include "physics/contact/kept_energy.h"

#include <algorithm>
#include <cmath>

#include "physics/contact/three_at.h"
#include "physics/world/forces.h"

namespace careen {
namespace {

/// [1] of the energies that are summed: rounding.
constexpr double kRoundingOfEnergy = 0x1p-50;
/// [1] of the energy of motion: what velocities can be asked to give.
constexpr double kMostOfMotion = 0x1p-10;

}  // namespace

// Ends of joints count as long as they push; a rope that is slack is another's step.
bool KeptEnergy::isConstant() const {
  bool holds = false;
  for (std::size_t c = 0; c < system_.features().size(); ++c) {
    const ContactFeature& feature = system_.features()[c];
    if (system_.pushes(c) && !feature.isOfJoint()) {
      return false;
    }
    holds = holds || feature.isOfJoint();
  }
  return holds && !isGravitySloping(world_) && !world_.drag && world_.springs.empty() &&
         std::all_of(world_.joints.begin(), world_.joints.end(), [](const Joint& joint) {
           return joint.damping == 0 && joint.effort == 0 && joint.grip == 0;
         });
}

bool KeptEnergy::isFree() const {
  for (std::size_t c = 0; c < system_.features().size(); ++c) {
    const ContactFeature& feature = system_.features()[c];
    if (system_.pushes(c) && (system_.bodies()[static_cast<std::size_t>(feature.a)].isHeld() ||
                              system_.bodies()[static_cast<std::size_t>(feature.b)].isHeld())) {
      return false;
    }
  }
  return true;
}

KeptEnergy::Energy KeptEnergy::energyOf(std::span<const double> y) const {
  Energy energy;
  std::vector<GroupMember> members;
  std::vector<Pose> poses(system_.bodies().size());
  const auto add = [&](double part) {
    energy.total += part;
    energy.largest = std::max(energy.largest, std::fabs(part));
  };
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const TouchingBody& body = system_.bodies()[i];
    if (body.isHeld()) {
      poses[i] = system_.kinematics(i).pose;
      continue;
    }
    const std::size_t at = system_.placeOf(i) * ContactSystem::kNumbers;
    const MassProperties& mass = body.body->mass;
    const Mat3 axes = quatAt(y, at + 3).normalized().toRotationMatrix();
    poses[i] = {.position = threeAt(y, at), .worldFromBody = axes};
    members.push_back({.mass = &mass,
                       .state = {.pose = poses[i],
                                 .velocity = threeAt(y, at + 7),
                                 .angularMomentum = axes * mass.inertiaTimes(threeAt(y, at + 10))}});
    add(kineticEnergy(mass, members.back().state));
    add(-mass.mass * dot(world_.gravity, poses[i].position - origins_[i]));
  }
  for (const ContactFeature& feature : system_.features()) {
    const Joint* joint = feature.joint;
    if (feature.part == JointPart::kPoint && joint != nullptr && joint->stiffness != 0) {
      const double extension = jointCoordinate(*joint, poses[static_cast<std::size_t>(feature.a)],
                                               poses[static_cast<std::size_t>(feature.b)]) -
                               joint->rest;
      add(0.5 * joint->stiffness * extension * extension);
    }
  }
  const bool isInFlight = isFree();
  if (isInFlight) {
    energy.rigid = momentumOf(members);
    energy.turning = energy.rigid.inertia.inverse() * energy.rigid.spin;
  }
  for (const GroupMember& member : members) {
    const Vec3 velocity =
        member.state.velocity - energy.rigid.velocity -
        (isInFlight ? Vec3(energy.turning.cross(member.state.pose.position - energy.rigid.center))
                    : Vec3(Vec3::Zero()));
    const Vec3 spin = angularVelocity(*member.mass, member.state) - energy.turning;
    energy.relative +=
        0.5 * (member.mass->mass * velocity.squaredNorm() +
               dot(spin, angularMomentum(*member.mass, member.state.pose.worldFromBody, spin)));
  }
  return energy;
}

void KeptEnergy::begin(std::span<const double> y) {
  if (!isConstant()) {
    due_.reset();
  } else if (!due_) {
    origins_.clear();
    for (std::size_t i = 0; i < system_.bodies().size(); ++i) {
      origins_.push_back(system_.kinematics(i).pose.position);
    }
    due_ = energyOf(y).total;
  }
}

bool KeptEnergy::keep(std::vector<double>& y) const {
  if (!due_) {
    return false;
  }
  const Energy now = energyOf(y);
  const double lacking = *due_ - now.total;
  if (std::fabs(lacking) <= kRoundingOfEnergy * now.largest ||
      std::fabs(lacking) > kMostOfMotion * now.relative) {
    return false;
  }
  const double scale = std::sqrt(1 + lacking / now.relative);
  for (std::size_t i = 0; i < system_.bodies().size(); ++i) {
    if (system_.bodies()[i].isHeld()) {
      continue;
    }
    const std::size_t at = system_.placeOf(i) * ContactSystem::kNumbers;
    const Mat3 axes = quatAt(y, at + 3).normalized().toRotationMatrix();
    const Vec3 rigid = now.rigid.velocity + now.turning.cross(threeAt(y, at) - now.rigid.center);
    const Vec3 turning = axes.transpose() * now.turning;
    setThree(y, at + 7, rigid + scale * (threeAt(y, at + 7) - rigid));
    setThree(y, at + 10, turning + scale * (threeAt(y, at + 10) - turning));
  }
  return true;
}

}  // namespace careen
