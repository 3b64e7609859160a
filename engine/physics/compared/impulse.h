#pragma once

#include "physics/world/body.h"

namespace careen {

/// One of the two bodies of a collision, as it moves.
struct CollidingBody {
  const MassProperties& mass;
  BodyState& state;
};

/// Velocity of the point of A at P less that of B, along the normal n [m/s]; negative: they are closing in.
double normalVelocity(const CollidingBody& a, const CollidingBody& b, const Vec3& point, const Vec3& normal);

/// Size j of the frictionless impulse j·n that A gets, and B against it, at the world point P (Fig. 4):
///
///   j = −(1+e) v_AB·n / { n·n (1/M_A + 1/M_B) + [(I_A⁻¹(r_A×n))×r_A + (I_B⁻¹(r_B×n))×r_B]·n }
///
/// with r from each centre of mass to P. After it v_AB·n is −e times what it was. n points from B to A and
/// need not be unit; j·n is the impulse [N s]. A wall is a body with immovable(): its terms vanish. Not both
/// bodies may be immovable.
double collisionImpulse(const CollidingBody& a, const CollidingBody& b, const Vec3& point, const Vec3& normal,
                        double restitution);

/// An impulse [N s] at a world point changes p by J and L by r × J.
void applyImpulse(const CollidingBody& body, const Vec3& point, const Vec3& impulse);

/// What a frictionless impulse j along a unit normal does to the kinetic energy of the two [J]: the work of j
/// over the mean of the normal speeds before, −approach, and after, e · approach. Never positive for e ≤ 1.
double impactEnergyChange(double approach, double impulse, double restitution);

}  // namespace careen
