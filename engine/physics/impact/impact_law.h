#pragma once

#include <span>

#include "physics/world/body.h"
#include "physics/world/partner.h"

namespace careen {

/// One body of an impact: what it is, and its state, which the impact changes in velocity and angular
/// momentum.
struct ImpactBody {
  const MassProperties* mass = nullptr;
  BodyState* state = nullptr;
};

/// One point where two bodies, or a body and a wall, touch at the moment of the impact.
///
/// The point is given by its arms, not in the world: position + arm − position is not arm in floating point,
/// and that rounding would tilt a cube that lands flat.
struct ImpactContact {
  int a = 0;                    ///< index among the bodies; the normal points to it
  Partner b = {};               ///< a wall, or an index among the bodies
  Vec3 armA = Vec3::Zero();     ///< [m] world, from a's centre of mass to the point
  Vec3 armB = Vec3::Zero();     ///< [m] world, from b's; not read for a wall
  Vec3 normal = Vec3::UnitZ();  ///< [1] unit, from b to a
  Material material;            ///< of the pair, see touching()
};

/// What an impact did at one contact.
struct ImpactShare {
  double approach = 0;    ///< [m/s] normal speed before, positive: closing in
  double impulse = 0;     ///< [N s] along the normal, ≥ 0
  double tangential = 0;  ///< [N s] size of the friction part, ≤ μ · impulse
};

/// Resolves all contacts at once: changes velocities and angular momenta, and fills one share per contact.
/// Contacts that do not approach take part, and may be hit through their neighbours. Throws NumericalError if
/// a number is not finite or neither side of a contact can move.
///
/// The law, q being all velocities, |q|² twice the kinetic energy, K the motions in which no contact
/// approaches:
///
/// * e = 1: generalized reflections G (B. Smith, D. M. Kaufman, E. Vouga, R. Tamstorf, E. Grinspun,
/// "Reflections on
///   simultaneous impact", ACM Trans. Graph. 31, 2012): project q onto the cone of the contacts that
///   approach, go as far again, repeat until none approaches. Each pass is a reflection, so energy is kept.
/// * e = 0: the projection P of q onto K: of all motions that impulses along the normals reach and that
/// penetrate
///   nothing, the one with the least energy (J. J. Moreau 1988).
/// * between: e G(q) + (1−e) P(q). Both lie in K and in the ball |·| ≤ |q|, both are convex: nothing
/// approaches
///   afterwards and no energy is gained, by construction. One contact alone parts with −e times its speed
///   (Fig. 4).
/// * e different per contact: ∫₀¹ Xₜ(q) dt, where Xₜ treats contact i as e = 1 if eᵢ > t, else as e = 0; a
/// finite sum,
///   for the eᵢ are few. It is the line above when all are equal, and holds for the same reasons.
/// * friction: let w = (the result above) − P(q) be what restitution adds. Friction takes the tangential
/// impulses of
///   least energy within |j_t| ≤ μ j_n at the end of compression, q⁺ − w, while normal impulses adapt so that
///   normal speeds stay what restitution made them, where a contact goes on pushing. So friction opposes the
///   slip that is left, or sticks, in any direction alike. Measuring slip before restitution is what keeps
///   energy from rising (the paradox of Kane and Levinson 1985): restitution's own tangential part is
///   elastic. For one contact it is a scalar equation, and the energy balance is that of A. Chatterjee, A.
///   Ruina, "A new algebraic rigid-body collision law based on impulse space considerations", J. Appl. Mech.
///   65, 1998, with their direction replaced by that of largest dissipation (as in S. Rakshit, A. Chatterjee,
///   Int. J. Mech. Sci. 90, 2015). For several contacts, where a lever lifts one of them, the step is cut
///   short if energy would rise.
///
/// Nothing is taken from the heap for up to a dozen contacts of one body. One contact: impulses in extended
/// precision, so that 10⁶ bounces keep energy to 1e-12. Several: to a few ulps. The order of the contacts
/// changes no bit; that of the bodies may change the last one, so give them in an order that does not depend
/// on the scene's listing. Mirrored in a coordinate plane, and scaled by powers of two, the same impact has
/// the same bits. What the rounding of the impulses leaves of a component that vanishes is set to zero.
void resolveImpact(std::span<const ImpactBody> bodies, std::span<const ImpactContact> contacts,
                   std::span<ImpactShare> shares);

/// Speed below which a contact counts as not approaching, as part of Σ|n_k q_k| at its contacts: rounding
/// error.
inline constexpr double kApproachRounding = 0x1p-46;

}  // namespace careen
