#pragma once

#include <span>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/world/world.h"

namespace careen {

/// A body of a pile: what of Body and BodyState its inner loops read, and how it moves between contacts.
struct PileBody {
  Vec3 halfExtents = Vec3::Zero();         ///< [m]
  double radius = 0;                       ///< [m] of the sphere about the centre that holds the box
  double length = 0;                       ///< [m] the smallest size: what all tolerances are parts of
  double inverseMass = 0;                  ///< [1/kg] 0: held
  Vec3 inertiaBody = Vec3::Zero();         ///< [kg m²]
  Vec3 inverseInertiaBody = Vec3::Zero();  ///< [1/(kg m²)]
  Material material;

  Vec3 position = Vec3::Zero();         ///< [m]
  Quat attitude = Quat::Identity();     ///< worldFromBody
  Mat3 axes = Mat3::Identity();         ///< worldFromBody
  Vec3 velocity = Vec3::Zero();         ///< [m/s]
  Vec3 angularMomentum = Vec3::Zero();  ///< [kg m²/s] primary: ω follows from it
  Vec3 omega = Vec3::Zero();            ///< [rad/s]

  double path = 0;   ///< [m] bound on how far any point of it has gone in all, grows only
  double ahead = 0;  ///< [m] the same for the substep to come
  int cluster = -1;  ///< asleep: which bodies wake with it
  bool held = false;
  bool asleep = false;

  /// Nothing moves it in this substep.
  bool still() const { return held || asleep; }
};

PileBody pileBody(const Body& body, const BodyState& state);
BodyState stateOf(const PileBody& body);

/// ω = A Ī⁻¹ Aᵀ L (Eq. 18).
void deriveOmega(PileBody& body);

/// Turns a free body for h [s]: A ← A exp θ̃, L constant in the world.
///
/// θ is the fourth-order start of Magnus' series for Ȧ = A ω̃ with ω expanded about the start,
///     θ = h ω + h²/2 ω̇ + h³/6 ω̈ + h³/12 ω × ω̇,   ω̇ = Ī⁻¹(m × ω),   m = Aᵀ L, body frame:
/// local error O(h⁴). One evaluation, no sines (the quaternion's two series are cut at θ¹⁰ and normalised).
/// A turn of more than half a radian is left to strangSteps.
///
/// Source: A. Iserles & S. P. Nørsett, Phil. Trans. R. Soc. A 357, 1999.
void turnFree(PileBody& body, double h);

/// Turns by a small rotation vector of the world: what a projection of positions does.
void turnBy(PileBody& body, const Vec3& rotation);

}  // namespace careen
