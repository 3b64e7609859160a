#pragma once

#include <span>
#include <vector>

#include "physics/world/world.h"

namespace careen {

/// What acts on one body: F_T of Eq. 14 and τ_T of Eq. 16.
struct Load {
  Vec3 force = Vec3::Zero();   ///< [N]
  Vec3 torque = Vec3::Zero();  ///< [N m] about the centre of mass
};

/// F = −linear · v, τ = −angular · ω.
Load dragLoad(const Drag& drag, const Vec3& velocity, const Vec3& angularVelocity);

/// A spring at one moment.
struct Stretch {
  Vec3 from = Vec3::Zero();       ///< [m] world
  Vec3 to = Vec3::Zero();         ///< [m] world
  Vec3 direction = Vec3::Zero();  ///< [1] unit, from → to; zero where the ends meet and no line joins them
  double length = 0;              ///< [m]
  double rate = 0;                ///< [m/s] of the length
};
/// `states` has one entry per body of the world.
Stretch stretchOf(const Spring& spring, const World& world, std::span<const BodyState> states);

/// k (length − rest) + c · rate, [N]; positive draws the ends together.
double springForce(const Spring& spring, const Stretch& stretch);

/// ½ k (length − rest)² summed over the springs, [J].
double springEnergy(const World& world, std::span<const BodyState> states);

/// Power of spring damping and drag, [W]; never positive for damping and drag ≥ 0.
double dissipation(const World& world, std::span<const BodyState> states);

/// Total force and torque on every body from gravity, drag and springs. What acts on an immovable body is in
/// the list too, its weight excepted, and moves nothing.
void computeLoads(const World& world, std::span<const BodyState> states, std::vector<Load>& loads);

}  // namespace careen
