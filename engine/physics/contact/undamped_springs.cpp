#include "physics/contact/undamped_springs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/disjoint_sets.h"
#include "core/math/order_free_sum.h"
#include "physics/contact/group_momentum.h"
#include "physics/contact/three_at.h"
#include "physics/world/forces.h"

namespace careen {
namespace {

constexpr int kMostPasses = 4;
constexpr double kExact = 0x1p-52;      // [1] of the energy
constexpr double kSoft = 0x1p-20;       // [1] of the inertia, for what has none about some axis
constexpr double kMostScaled = 0x1p-8;  // [1] a step that is off by more is not put right by this

double sumOf(const std::vector<std::array<double, 1>>& terms) { return orderFreeSums<1>(terms)[0]; }

}  // namespace

/// Velocities about the rigid motion of a group, forces, and its energy.
struct UndampedSprings::Motions {
  std::vector<Vec3> velocities;  // [m/s]
  std::vector<Vec3> spins;       // [rad/s] world frame; 0 where nothing turns the body
  std::vector<Vec3> forces;      // [N] over the mass
  std::vector<Vec3> torques;     // [N m] times the inverse inertia
  double energy = 0;             // [J] of a free group: about its centre
  double scale = 0;              // [J] the same without signs
  double twice = 0;              // [J] 2 T + τ² F·M⁻¹F
};

UndampedSprings::UndampedSprings(const World& world, std::span<const TouchingBody> bodies) : world_(world) {
  if (world.springs.empty() || world.drag) {
    return;
  }
  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> placeOf(world.bodies.size(), kNone);
  std::vector<Member> members;
  for (const TouchingBody& body : bodies) {
    if (!body.isHeld()) {
      placeOf[static_cast<std::size_t>(body.index)] = members.size();
      members.push_back({.at = members.size() * ContactSystem::kNumbers,
                         .index = static_cast<std::size_t>(body.index),
                         .body = body.body});
    }
  }
  const auto memberAt = [&](const SpringEnd& end) {
    return end.body ? placeOf[static_cast<std::size_t>(*end.body)] : kNone;
  };
  DisjointSets joined(members.size());
  for (const Spring& spring : world.springs) {
    if (memberAt(spring.from) != kNone && memberAt(spring.to) != kNone) {
      joined.join(memberAt(spring.from), memberAt(spring.to));
    }
  }
  std::vector<Group> groups(members.size());
  std::vector<char> loses(members.size(), 0);
  for (std::size_t index = 0; index < world.springs.size(); ++index) {
    const Spring& spring = world.springs[index];
    double stiffness = 0;
    std::size_t root = kNone;
    bool free = true;
    for (const SpringEnd* end : {&spring.from, &spring.to}) {
      const std::size_t place = memberAt(*end);
      if (place == kNone) {
        free = false;
        continue;
      }
      root = joined.root(place);
      const MassProperties& mass = members[place].body->mass;
      members[place].turns = members[place].turns || !end->point.isZero(0);
      stiffness += spring.stiffness *
                   (mass.inverseMass + mass.inverseInertiaBody.maxCoeff() * end->point.squaredNorm());
    }
    if (root != kNone) {
      groups[root].springs.push_back(index);
      groups[root].free = groups[root].free && free;
      groups[root].period += stiffness;
      loses[root] = loses[root] != 0 || spring.damping != 0 ? 1 : 0;
    }
  }
  for (std::size_t place = 0; place < members.size(); ++place) {
    members[place].mass = members[place].body->mass;
    if (!members[place].turns) {
      members[place].mass.inertiaBody.setZero();
    }
    groups[joined.root(place)].members.push_back(members[place]);
  }
  for (std::size_t root = 0; root < groups.size(); ++root) {
    if (groups[root].period > 0 && loses[root] == 0) {
      groups[root].period = 1 / groups[root].period;
      groups_.push_back(std::move(groups[root]));
    }
  }
  if (!groups_.empty()) {
    for (const Body& body : world.bodies) {
      states_.push_back(body.initial);
    }
  }
}

BodyState UndampedSprings::stateOf(const Member& member, std::span<const double> y) const {
  const Mat3 axes = quatAt(y, member.at + 3).normalized().toRotationMatrix();
  return {.pose = {.position = threeAt(y, member.at), .worldFromBody = axes},
          .velocity = threeAt(y, member.at + 7),
          .angularMomentum = axes * member.body->mass.inertiaTimes(threeAt(y, member.at + 10))};
}

// Spins that no torque changes are no part of what turns together: such bodies are points, whose inertia
// about a line through all of them is 0.
GroupMomentum UndampedSprings::momentumOfGroup(const Group& group, std::span<const double> y) const {
  std::vector<GroupMember> members;
  for (const Member& member : group.members) {
    BodyState state = stateOf(member, y);
    if (!member.turns) {
      state.angularMomentum.setZero();
    }
    members.push_back({.mass = &member.mass, .state = state});
  }
  GroupMomentum momentum = momentumOf(members);
  momentum.inertia += kSoft * momentum.inertia.trace() * Mat3::Identity();
  return momentum;
}

UndampedSprings::Motions UndampedSprings::motionsOf(const Group& group, std::span<const double> y) {
  for (const Member& member : group.members) {
    states_[member.index] = stateOf(member, y);
  }
  GroupMomentum rigid;
  Vec3 turning = Vec3::Zero();
  if (group.free) {
    rigid = momentumOfGroup(group, y);
    turning = rigid.inertia.inverse() * rigid.spin;
  }
  std::vector<Load> loads(world_.bodies.size());
  std::vector<std::array<double, 1>> energies;
  std::vector<std::array<double, 1>> scales;
  const auto addEnergy = [&](double energy) {
    energies.push_back({energy});
    scales.push_back({std::fabs(energy)});
  };
  for (const std::size_t index : group.springs) {
    const Spring& spring = world_.springs[index];
    const Stretch stretch = stretchOf(spring, world_, states_);
    const double extension = stretch.length - spring.restLength;
    addEnergy(0.5 * spring.stiffness * extension * extension);
    const Vec3 force = spring.stiffness * extension * stretch.direction;
    const auto pull = [&](const SpringEnd& end, const Vec3& point, const Vec3& by) {
      if (end.body) {
        const auto body = static_cast<std::size_t>(*end.body);
        loads[body].force += by;
        loads[body].torque += (point - states_[body].pose.position).cross(by);
      }
    };
    pull(spring.from, stretch.from, force);
    pull(spring.to, stretch.to, -force);
  }
  Motions motions;
  std::vector<std::array<double, 1>> twice;
  for (const Member& member : group.members) {
    const MassProperties& mass = member.body->mass;
    const BodyState& state = states_[member.index];
    const Vec3 spin = angularVelocity(mass, state);
    const Vec3 relative = group.free ? Vec3(state.velocity - rigid.velocity) : state.velocity;
    addEnergy(0.5 * mass.mass * relative.squaredNorm());
    Load load = loads[member.index];
    if (!group.free) {
      load.force += mass.mass * world_.gravity;
      addEnergy(-mass.mass * dot(world_.gravity, state.pose.position - member.origin));
    }
    const Mat3 inverse = inverseInertiaWorld(mass, state.pose.worldFromBody);
    motions.velocities.push_back(relative - (group.free
                                                 ? Vec3(turning.cross(state.pose.position - rigid.center))
                                                 : Vec3(Vec3::Zero())));
    motions.spins.push_back(member.turns ? Vec3(spin - turning) : Vec3(Vec3::Zero()));
    motions.forces.push_back(mass.inverseMass * load.force);
    motions.torques.push_back(member.turns ? Vec3(inverse * load.torque) : Vec3(Vec3::Zero()));
    twice.push_back({mass.mass * motions.velocities.back().squaredNorm()});
    twice.push_back({group.period * dot(load.force, motions.forces.back())});
    if (member.turns) {
      addEnergy(0.5 * dot(spin, state.angularMomentum));
      twice.push_back(
          {dot(motions.spins.back(), angularMomentum(mass, state.pose.worldFromBody, motions.spins.back()))});
      twice.push_back({group.period * dot(load.torque, motions.torques.back())});
    }
  }
  motions.energy = sumOf(energies);
  motions.scale = sumOf(scales);
  motions.twice = sumOf(twice);
  return motions;
}

void UndampedSprings::begin(std::span<const double> y) {
  if (begun_) {
    return;
  }
  begun_ = true;
  for (Group& group : groups_) {
    for (Member& member : group.members) {
      member.origin = threeAt(y, member.at);
      const BodyState state = stateOf(member, y);
      member.energy = 0.5 * dot(angularVelocity(member.body->mass, state), state.angularMomentum);
    }
    group.energy = motionsOf(group, y).energy;
  }
}

// Of a body without torque: its angular momentum, and by a small turn along ω × L, the gradient of its
// energy, that too.
void UndampedSprings::keepSpin(const Member& member, const Vec3& kept, std::vector<double>& y) {
  const MassProperties& mass = member.body->mass;
  Quat attitude = quatAt(y, member.at + 3).normalized();
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const Mat3 axes = attitude.toRotationMatrix();
    const Vec3 spin = mass.inverseInertiaTimes(axes.transpose() * kept);
    setThree(y, member.at + 10, spin);
    const Vec3 world = axes * spin;
    const double excess = 0.5 * dot(world, kept) - member.energy;
    const Vec3 slope = world.cross(kept);
    if (std::fabs(excess) <= kExact * member.energy || std::fabs(excess) > kMostScaled * slope.norm()) {
      return;
    }
    const Vec3 turn = (-0.5 * excess / slope.squaredNorm()) * slope;
    attitude = (Quat(1, turn.x(), turn.y(), turn.z()) * attitude).normalized();
    setQuat(y, member.at + 3, attitude);
  }
}

void UndampedSprings::keepMomenta(const Group& group, std::span<const double> before, double h,
                                  std::vector<double>& y) const {
  for (const Member& member : group.members) {
    if (!member.turns) {
      keepSpin(member, stateOf(member, before).angularMomentum, y);
    }
  }
  if (!group.free) {
    return;
  }
  const std::optional<RigidChange> change =
      changeTo(momentumOfGroup(group, before), h, world_.gravity, momentumOfGroup(group, y));
  for (std::size_t k = 0; change && k < group.members.size(); ++k) {
    const std::size_t at = group.members[k].at;
    const Vec3 place = threeAt(y, at);
    setThree(y, at, place + change->shift);
    setThree(y, at + 7, threeAt(y, at + 7) + change->velocityAt(place));
    if (group.members[k].turns) {
      const Mat3 axes = quatAt(y, at + 3).normalized().toRotationMatrix();
      setThree(y, at + 10, threeAt(y, at + 10) + axes.transpose() * change->turning);
    }
  }
}

// Whether anything was changed.
bool UndampedSprings::keepEnergy(const Group& group, std::vector<double>& y) {
  const Motions motions = motionsOf(group, y);
  const double excess = motions.energy - group.energy;
  if (!(std::fabs(excess) > kExact * motions.scale) || !(motions.twice > 0) ||
      std::fabs(excess) > kMostScaled * motions.twice) {
    return false;
  }
  const double part = excess / motions.twice;
  for (std::size_t k = 0; k < group.members.size(); ++k) {
    const Member& member = group.members[k];
    const Mat3 axes = states_[member.index].pose.worldFromBody;
    setThree(y, member.at, threeAt(y, member.at) + part * group.period * motions.forces[k]);
    setThree(y, member.at + 7, threeAt(y, member.at + 7) - part * motions.velocities[k]);
    if (member.turns) {
      const Vec3 turn = 0.5 * part * group.period * motions.torques[k];
      const Quat turned =
          (Quat(1, turn.x(), turn.y(), turn.z()) * quatAt(y, member.at + 3).normalized()).normalized();
      const Vec3 spin = axes * threeAt(y, member.at + 10) - part * motions.spins[k];
      setQuat(y, member.at + 3, turned);
      setThree(y, member.at + 10, turned.toRotationMatrix().transpose() * spin);
    }
  }
  return true;
}

bool UndampedSprings::keep(std::span<const double> before, double h, std::vector<double>& y) {
  if (!begun_ || groups_.empty()) {
    return false;
  }
  for (const Group& group : groups_) {
    keepMomenta(group, before, h, y);
    for (int pass = 0; pass < kMostPasses && keepEnergy(group, y); ++pass) {
      keepMomenta(group, before, h, y);
    }
  }
  return true;
}

}  // namespace careen
