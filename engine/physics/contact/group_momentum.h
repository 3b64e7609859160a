#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/contact/contact_feature.h"
#include "physics/world/world.h"

namespace careen {

struct TouchingBody;

struct GroupMember {
  const MassProperties* mass = nullptr;
  BodyState state = {};
};

/// Momenta of bodies on which nothing acts but gravity, and contacts and springs between them. The errors of
/// steps and of projections change them. A rigid motion of all of the bodies puts that right: no gap, no
/// approach and no slip between them notices it.
struct GroupMomentum {
  double mass = 0;               ///< [kg]
  Vec3 center = Vec3::Zero();    ///< [m] of mass
  Vec3 velocity = Vec3::Zero();  ///< [m/s] of it
  Vec3 spin = Vec3::Zero();      ///< [kg m²/s] angular momentum about it
  Mat3 inertia = Mat3::Zero();   ///< [kg m²] about it, of all bodies as one
  double speed = 0;              ///< [m/s] largest of a body
  double largestSpin = 0;        ///< [kg m²/s] largest share of a body in `spin`
};

/// Those of `bodies` on which nothing but each other pushes and pulls, as groups of indices. `pushing`: the
/// contacts with forces.
std::vector<std::vector<std::size_t>> freeGroups(const World& world, std::span<const TouchingBody> bodies,
                                                 std::span<const ContactFeature> pushing);

/// The order of the members changes no bit.
GroupMomentum momentumOf(std::span<const GroupMember> members);

/// A displacement without rotation, and the velocities of a rigid motion.
struct RigidChange {
  Vec3 center = Vec3::Zero();    ///< [m]
  Vec3 shift = Vec3::Zero();     ///< [m]
  Vec3 velocity = Vec3::Zero();  ///< [m/s] of the centre
  Vec3 turning = Vec3::Zero();   ///< [rad/s]

  Vec3 velocityAt(const Vec3& point) const { return velocity + turning.cross(point - center); }
};

/// What takes `before`, left alone for h [s] under gravity, [m/s²] at first, that grows by `slope` [m/s³],
/// from `now` to where it has to be; nothing if they differ by rounding only.
std::optional<RigidChange> changeTo(const GroupMomentum& before, double h, const Vec3& gravity,
                                    const GroupMomentum& now, const Vec3& slope = Vec3::Zero());

/// Of each body, by its index, that has to move so that the groups of those that only push each other get the
/// momenta that they had `h` [s] before, at a time [s]. `before`, `now`: the states of a body.
using StateOfBody = std::function<BodyState(std::size_t)>;
std::vector<std::pair<std::size_t, RigidChange>> changesToKeep(
    const World& world, std::span<const TouchingBody> bodies, std::span<const ContactFeature> pushing,
    double time, double h, const StateOfBody& before, const StateOfBody& now);

}  // namespace careen
