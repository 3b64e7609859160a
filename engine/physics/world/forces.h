#pragma once

#include <span>
#include <vector>

#include "physics/world/world.h"

namespace careen {

/// Total load on one body: F_T of Eq. 14 and τ_T of Eq. 16.
struct Load {
  Vec3 force = Vec3::Zero();   ///< [N]
  Vec3 torque = Vec3::Zero();  ///< [N m] about the centre of mass
};

/// F = −linear · v, τ = −angular · ω.
Load dragLoad(const Drag& drag, const Vec3& velocity, const Vec3& angularVelocity);

/// State of a spring at one time.
struct Stretch {
  Vec3 from = Vec3::Zero();       ///< [m] world
  Vec3 to = Vec3::Zero();         ///< [m] world
  Vec3 direction = Vec3::Zero();  ///< [1] unit, from → to; zero if the ends coincide
  double length = 0;              ///< [m]
  double rate = 0;                ///< [m/s] rate of the length
};
/// `states` has one entry per body of the world.
Stretch stretchOf(const Spring& spring, const World& world, std::span<const BodyState> states);

/// A hinge's or slider's coordinate q and its rate at one time.
struct JointMotion {
  double coordinate = 0;      ///< [rad] or [m]
  double rate = 0;            ///< [rad/s] or [m/s]
  Vec3 axis = Vec3::UnitZ();  ///< [1] world
  Vec3 point = Vec3::Zero();  ///< [m] world, of `from`
};
JointMotion jointMotionOf(const Joint& joint, const World& world, std::span<const BodyState> states);

/// effort − stiffness (q − rest) − damping q̇, [N] or [N m], on `from` along the axis.
double jointForce(const Joint& joint, const JointMotion& motion);

/// Whether there are springs, or joints with a load of their own; whether loads depend on more than gravity.
bool hasSprings(const World& world);
inline bool hasVaryingLoads(const World& world) { return world.drag.has_value() || hasSprings(world); }

/// k (length − rest) + c · rate, [N]; positive in tension.
double springForce(const Spring& spring, const Stretch& stretch);

/// ½ k (length − rest)² summed over the springs, and those of joints, [J].
double springEnergy(const World& world, std::span<const BodyState> states);

/// Power of damping in springs and joints, and drag, [W]; never positive for damping and drag ≥ 0.
double dissipation(const World& world, std::span<const BodyState> states);

/// Total force and torque on every body from gravity [m/s²], drag, springs and loaded joints. Loads on
/// immovable bodies are listed too, without weight, and have no effect.
void computeLoads(const World& world, const Vec3& gravity, std::span<const BodyState> states,
                  std::vector<Load>& loads);

/// [m/s²] Of each body's centre of mass at the start, without contacts.
std::vector<double> accelerationsAtStart(const World& world);

/// [m/s²] Scale of each body's accelerations without contacts: gravity's, or what its springs give it now or
/// will at this speed within a radian of their oscillation, √(k/m).
std::vector<double> pulls(const World& world, std::span<const BodyState> states);

}  // namespace careen
