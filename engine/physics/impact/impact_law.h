#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "physics/geometry/separating_axes.h"
#include "physics/solver/contact_rows.h"
#include "physics/world/body.h"
#include "physics/world/contact_residuals.h"

namespace careen {

/// One body of an impact: its mass and its state, in which the impact changes velocity and angular momentum.
/// A wall is one that cannot be moved; what is held but moves by itself keeps its velocity.
struct ImpactBody {
  const MassProperties* mass = nullptr;
  BodyState* state = nullptr;

  bool isDriven() const {
    return isImmovable(*mass) && !(state->velocity.isZero(0) && state->angularMomentum.isZero(0));
  }
};

/// One point where two bodies touch at the moment of the impact.
///
/// The point is given by its arms, not in world coordinates: position + arm − position is not arm in floating
/// point, and that rounding would tilt a cube that lands flat.
struct ImpactContact {
  int a = 0;                    ///< index among the bodies; the normal points to it
  int b = 0;                    ///< index among the bodies
  Vec3 armA = Vec3::Zero();     ///< [m] world, from a's centre of mass to the point
  Vec3 armB = Vec3::Zero();     ///< [m] world, from b's; not read if b does not move
  Vec3 normal = Vec3::UnitZ();  ///< [1] unit, from b to a
  Material material = {};       ///< of the pair, see touching()
  int boxA = 0;                 ///< which of a's boxes touches
  int boxB = 0;                 ///< one of b's
  int corner = -1;              ///< of a, that touches a wall
  bool inCone = false;          ///< the normal is the centre of a cone, see ContactPoint
  AxisSet axes = 0;             ///< of both boxes, whose are
  /// [1] unit: the contact takes part only where its bodies would enter each other along all of them. None:
  /// the normal is the only one.
  std::vector<Vec3> directions = {};
  /// A joint's rows, in place of normal and arms.
  std::shared_ptr<const ConstraintRows> rows = {};
  bool holds = false;  ///< it takes every impulse: its speeds stay zero
  static constexpr int kNoJoint = -1;
  int joint = kNoJoint;  ///< of a joint's condition: its index, as the caller counts
};

/// What an impact did at one contact.
struct ImpactShare {
  double approach = 0;           ///< [m/s] normal speed before, positive: approaching
  double impulse = 0;            ///< [N s] along the normal, ≥ 0
  double tangential = 0;         ///< [N s] size of the friction part, ≤ μ · impulse
  Vec3 normal = Vec3::Zero();    ///< [1] along which it acted: the contact's, or one of its directions
  std::array<double, 3> rows{};  ///< [N s] of a joint's condition, along its rows; `impulse` is their size
};

/// Residuals of the equations of several contacts [m/s] that the caller can do with; 0: rounding.
struct ImpactAccuracy {
  double enough = 0;     ///< of friction's: no better one is looked for
  double tolerable = 0;  ///< where no better one is found
};

/// Resolves all contacts at once: changes velocities and angular momenta, and fills one share per contact.
/// Contacts that do not approach take part: impulses may reach them through their neighbours. Throws
/// NumericalError if a number is not finite or neither side of a contact can move.
///
/// Of contacts with a choice of directions only those take part that the motion without them would enter
/// along all: the law below is solved without them, then with those, until none is added. A cube that is
/// struck in the middle of a block of cubes so moves its own row, not what it touches along an edge.
///
/// The law, q being all velocities, |q|² twice the kinetic energy, K the motions in which no contact
/// approaches:
///
/// * e = 1: generalized reflections G (B. Smith, D. M. Kaufman, E. Vouga, R. Tamstorf, E. Grinspun,
///   "Reflections on simultaneous impact", ACM Trans. Graph. 31, 2012): project q onto the cone of the
///   approaching contacts, go the same distance again, repeat until none approaches. Each pass is a
///   reflection, so energy is conserved.
/// * e = 0: the projection P of q onto K: of all motions without penetration that normal impulses can reach,
///   the one with the least energy (J. J. Moreau 1988).
/// * between: e G(q) + (1−e) P(q). Both lie in K and in the ball |·| ≤ |q|, both of which are convex: by
///   construction no contact approaches afterwards and no energy is gained. A single contact separates with
///   −e times its speed (Fig. 4).
/// * e different per contact: ∫₀¹ Xₜ(q) dt, where Xₜ treats contact i as e = 1 if eᵢ > t, else as e = 0; a
///   finite sum, since the eᵢ are few. If all are equal it is the line above; it holds for the same reasons.
///   Reflections and projections that go on for ever at the same contacts end where that leads: with the
///   projection at these.
/// * friction: let w = (the result above) − P(q) be what restitution adds. Friction takes the tangential
///   impulses of least energy within |j_t| ≤ μ j_n at the end of compression, q⁺ − w, while normal impulses
///   adapt so that contacts that stay active keep the normal speeds set by restitution. So friction opposes
///   the remaining slip, or sticks, and is isotropic. Slip is measured before restitution because that keeps
///   energy from rising (the paradox of Kane and Levinson 1985): the tangential part of restitution itself
///   is elastic. For one contact it is a scalar equation, and the energy balance is that of A. Chatterjee,
///   A. Ruina, "A new algebraic rigid-body collision law based on impulse space considerations", J. Appl.
///   Mech. 65, 1998, with their direction replaced by that of maximum dissipation (as in S. Rakshit, A.
///   Chatterjee, Int. J. Mech. Sci. 90, 2015). For several contacts, where leverage lifts one of them, the
///   step is shortened if energy would rise.
///
/// Joints belong to every projection: K is then of the motions that they allow, and since reflections within
/// a subspace are reflections all that is said above stays true.
///
/// No heap allocation for up to a dozen contacts of one body. One contact: impulses in extended precision, so
/// that 10⁶ bounces conserve energy to 1e-12. Several: to a few ulps. The order of the contacts changes no
/// bit; that of the bodies may change the last one, so give them in an order that does not depend on the
/// scene's listing. Mirrored in a coordinate plane, and scaled by powers of two, the same impact has the same
/// bits. Rounding residue in a component that should vanish is set to zero.
///
/// Returns the residuals of the contact problems that were solved for it; one contact needs none.
ContactResiduals resolveImpact(std::span<const ImpactBody> bodies, std::span<const ImpactContact> contacts,
                               std::span<ImpactShare> shares, ImpactAccuracy accuracy = {});

/// Speed below which a contact counts as not approaching, as a fraction of Σ|n_k q_k| at its contacts:
/// rounding error.
inline constexpr double kApproachRounding = 0x1p-46;

}  // namespace careen
