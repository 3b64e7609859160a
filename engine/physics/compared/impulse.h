#pragma once

#include "physics/world/body.h"

namespace careen {

/// One of the two bodies of a collision, with its state.
struct CollidingBody {
  const MassProperties& mass;
  BodyState& state;
};

/// Relative velocity of A's point at P to B's, along the normal n [m/s]; negative: approaching.
double normalVelocity(const CollidingBody& a, const CollidingBody& b, const Vec3& point, const Vec3& normal);

/// Magnitude j of the frictionless impulse j·n on A, and −j·n on B, at the world point P (Fig. 4):
///
///   j = −(1+e) v_AB·n / { n·n (1/M_A + 1/M_B) + [(I_A⁻¹(r_A×n))×r_A + (I_B⁻¹(r_B×n))×r_B]·n }
///
/// with r from each centre of mass to P. Afterwards v_AB·n is −e times its previous value. n points from B to
/// A and need not be unit; j·n is the impulse [N s]. A wall is a body with immovable(): its terms vanish. At
/// most one body may be immovable.
double collisionImpulse(const CollidingBody& a, const CollidingBody& b, const Vec3& point, const Vec3& normal,
                        double restitution);

/// An impulse [N s] at a world point changes p by J and L by r × J.
void applyImpulse(const CollidingBody& body, const Vec3& point, const Vec3& impulse);

/// Change of the kinetic energy of both bodies by a frictionless impulse j along a unit normal [J]: j times
/// the mean of the normal speeds before, −approach, and after, e · approach. Never positive for e ≤ 1.
double impactEnergyChange(double approach, double impulse, double restitution);

}  // namespace careen
