#include "physics/contact/group_momentum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/disjoint_sets.h"
#include "core/math/order_free_sum.h"
#include "physics/contact/contact_system.h"

namespace careen {
namespace {

/// [1] Differences this small are rounding.
constexpr double kSame = 0x1p-49;

Mat3 symmetric(const std::array<double, 9>& sums) {
  Mat3 matrix;
  matrix << sums[0], sums[3], sums[4], sums[3], sums[1], sums[5], sums[4], sums[5], sums[2];
  return matrix;
}

}  // namespace

std::vector<std::vector<std::size_t>> freeGroups(const World& world, std::span<const TouchingBody> bodies,
                                                 std::span<const ContactFeature> pushing) {
  if (world.drag) {
    return {};
  }
  const std::size_t count = bodies.size();
  DisjointSets joined(count);
  std::vector<char> pushed(count, 0);  // by what cannot move
  const auto moves = [&](std::size_t i) { return i < count && !bodies[i].isHeld(); };
  const auto join = [&](std::size_t a, std::size_t b) {
    if (moves(a) && moves(b)) {
      joined.join(a, b);
    } else if (moves(a) || moves(b)) {
      pushed[moves(a) ? a : b] = 1;
    }
  };
  for (const ContactFeature& feature : pushing) {
    join(static_cast<std::size_t>(feature.a), static_cast<std::size_t>(feature.b));
  }
  if (!world.springs.empty()) {
    std::vector<std::size_t> placeOf(world.bodies.size(), count);
    for (std::size_t i = 0; i < boxesOf(bodies); ++i) {
      placeOf[static_cast<std::size_t>(bodies[i].index)] = i;
    }
    const auto at = [&](const SpringEnd& end) {
      return end.body ? placeOf[static_cast<std::size_t>(*end.body)] : count;
    };
    for (const Spring& spring : world.springs) {
      join(at(spring.from), at(spring.to));
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (pushed[i] != 0 || !moves(i)) {
      pushed[joined.root(i)] = 1;
    }
  }
  std::vector<std::vector<std::size_t>> groups;
  std::vector<std::size_t> groupOf(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t root = joined.root(i);  // the least, so it comes first
    if (pushed[root] == 0) {
      if (root == i) {
        groupOf[i] = groups.size();
        groups.emplace_back();
      }
      groups[groupOf[root]].push_back(i);
    }
  }
  return groups;
}

GroupMomentum momentumOf(std::span<const GroupMember> members) {
  std::vector<std::array<double, 7>> firsts;
  GroupMomentum group;
  for (const auto& [mass, state] : members) {
    const Vec3 place = mass->mass * state.pose.position;
    const Vec3 momentum = mass->mass * state.velocity;
    firsts.push_back({mass->mass, place[0], place[1], place[2], momentum[0], momentum[1], momentum[2]});
    group.speed = std::max(group.speed, state.velocity.norm());
  }
  const std::array<double, 7> first = orderFreeSums<7>(firsts);
  group.mass = first[0];
  group.center = Vec3(first[1], first[2], first[3]) / group.mass;
  group.velocity = Vec3(first[4], first[5], first[6]) / group.mass;
  std::vector<std::array<double, 9>> seconds;
  for (const auto& [mass, state] : members) {
    const Vec3 arm = state.pose.position - group.center;
    const Mat3 axes = mass->worldFromPrincipal(state.pose.worldFromBody);
    const Mat3 own = axes * mass->inertiaBody.asDiagonal() * axes.transpose();
    const Mat3 all = own + mass->mass * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
    const Vec3 orbital = mass->mass * arm.cross(state.velocity - group.velocity);
    const Vec3 spin = state.angularMomentum + orbital;
    seconds.push_back(
        {all(0, 0), all(1, 1), all(2, 2), all(0, 1), all(0, 2), all(1, 2), spin[0], spin[1], spin[2]});
    group.largestSpin = std::max(
        {group.largestSpin, state.angularMomentum.norm(), mass->mass * arm.norm() * state.velocity.norm()});
  }
  const std::array<double, 9> second = orderFreeSums<9>(seconds);
  group.inertia = symmetric(second);
  group.spin = Vec3(second[6], second[7], second[8]);
  return group;
}

std::optional<RigidChange> changeTo(const GroupMomentum& before, double h, const Vec3& gravity,
                                    const GroupMomentum& now, const Vec3& slope) {
  const Vec3 moved = h * (before.velocity + (0.5 * h) * gravity + (h * h / 6) * slope);
  const RigidChange change{.center = now.center,
                           .shift = before.center + moved - now.center,
                           .velocity = before.velocity + h * gravity + (0.5 * h * h) * slope - now.velocity,
                           .turning = now.inertia.inverse() * (before.spin - now.spin)};
  const bool same = change.shift.norm() <= kSame * (now.center.norm() + moved.norm()) &&
                    change.velocity.norm() <= kSame * now.speed &&
                    (before.spin - now.spin).norm() <= kSame * now.largestSpin;
  return same ? std::nullopt : std::optional(change);
}

std::vector<std::pair<std::size_t, RigidChange>> changesToKeep(
    const World& world, std::span<const TouchingBody> bodies, std::span<const ContactFeature> pushing,
    double time, double h, const StateOfBody& before, const StateOfBody& now) {
  std::vector<std::pair<std::size_t, RigidChange>> changes;
  for (const std::vector<std::size_t>& group : freeGroups(world, bodies, pushing)) {
    const auto momentum = [&](const StateOfBody& stateOf) {
      std::vector<GroupMember> members;
      members.reserve(group.size());
      for (const std::size_t i : group) {
        members.push_back({.mass = &bodies[i].body->mass, .state = stateOf(i)});
      }
      return momentumOf(members);
    };
    if (const auto change =
            changeTo(momentum(before), h, gravityNow(world, time), momentum(now), gravitySlope(world))) {
      for (const std::size_t i : group) {
        changes.emplace_back(i, *change);
      }
    }
  }
  return changes;
}

}  // namespace careen
