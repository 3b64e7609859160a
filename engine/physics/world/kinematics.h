#pragma once

#include "core/math/linear_algebra.h"
#include "core/math/pose.h"

namespace careen {

/// A rigid motion at one moment, world frame.
struct Kinematics {
  Pose pose;
  Vec3 velocity = Vec3::Zero();         ///< [m/s] of the pose's origin
  Vec3 angularVelocity = Vec3::Zero();  ///< [rad/s]
  bool isDriven = false;                ///< of what is held and moves by itself: only then has it the others
  Vec3 acceleration = Vec3::Zero();     ///< [m/s²]
  Vec3 angularAcceleration = Vec3::Zero();  ///< [rad/s²]

  Vec3 velocityAt(const Vec3& arm) const { return velocity + angularVelocity.cross(arm); }
  /// [m/s²] Of the point at that arm, but for ω×(ω×arm).
  Vec3 accelerationAt(const Vec3& arm) const { return acceleration + angularAcceleration.cross(arm); }
};

// A point b fixed in a body whose centre of mass is o: r = A r̄ leads from o to b, world frame. Its position,
// b = o + r (Eq. 11), is Pose::worldPoint.

/// ḃ = ȯ + ω × r (Eq. 12), [m/s].
Vec3 pointVelocity(const Vec3& centerVelocity, const Vec3& angularVelocity, const Vec3& r);

/// a = F/M (Eq. 14), [m/s²]: the centre of mass moves as if the whole force acted there.
Vec3 centerAcceleration(double inverseMass, const Vec3& totalForce);

/// L_AB = r_AB × p_B (Eq. 15), [kg m²/s]: angular momentum about A of momentum p at B.
Vec3 angularMomentumAbout(const Vec3& r, const Vec3& momentum);

/// τ_AB = r_AB × F_B (Eq. 16), [N m]: the rate of L_AB.
Vec3 torqueAbout(const Vec3& r, const Vec3& force);

}  // namespace careen
