#pragma once

#include <span>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/world/world.h"

namespace careen {

/// Of what is held and does not move.
extern const CoursePart kStillPart;
/// A box of a body of a pile, or a half-space, where it is.
struct PileBox {
  const Wall* halfSpace = nullptr;  ///< its shape; null: a box, of these half sizes
  Vec3 halfExtents = Vec3::Zero();  ///< [m]
  const Vec3* center = nullptr;     ///< [m] middle of the box, own frame; null: the centre of mass
  Vec3 position = Vec3::Zero();     ///< [m] of the centre of mass
  Mat3 axes = Mat3::Identity();     ///< of the box, in the world

  bool isBox() const { return halfSpace == nullptr; }
  /// Of a half-space.
  WallPlane plane() const { return planeOf(*halfSpace, {position, axes}); }
  /// [m] World: from the centre of mass to the middle of the box, and the middle's place.
  Vec3 boxArm() const { return center == nullptr ? Vec3(Vec3::Zero()) : Vec3(axes * *center); }
  Vec3 middle() const { return center == nullptr ? position : Vec3(position + axes * *center); }
};

/// A body of a pile, a box or a half-space: the parts of Body and BodyState that the inner loops read, and
/// its motion between contacts. Of several boxes it is, as a box, that around all of them; its axes are the
/// body's.
struct PileBody : PileBox {
  const std::vector<BodyPart>* parts = nullptr;  ///< null: one box
  double radius = 0;                             ///< [m] bounding sphere about the centre of mass
  double length = 0;                             ///< [m] smallest size: tolerances are relative to it
  double inverseMass = 0;                        ///< [1/kg] 0: fixed body
  Vec3 inertiaBody = Vec3::Zero();               ///< [kg m²]
  Vec3 inverseInertiaBody = Vec3::Zero();        ///< [1/(kg m²)]
  const Mat3* bodyFromPrincipal = nullptr;       ///< null: the principal axes are the body's
  Material material;

  Quat attitude = Quat::Identity();     ///< worldFromBody
  Vec3 velocity = Vec3::Zero();         ///< [m/s]
  Vec3 angularMomentum = Vec3::Zero();  ///< [kg m²/s] primary state: ω is derived from it
  Vec3 omega = Vec3::Zero();            ///< [rad/s]
  double behind = 0;                    ///< [s] since it had its velocity: where pushed, that of mid-step

  double path = 0;     ///< [m] upper bound on the total path length of any of its points; never decreases
  double ahead = 0;    ///< [m] the same for the next substep
  double turned = 0;   ///< [m] the part of `path` that its rotation about its centre accounts for
  double turning = 0;  ///< [m] the same for the next substep
  int cluster = -1;    ///< if asleep: its cluster; all bodies of a cluster wake together
  /// Of what is held: how it moves, or kStillPart. Of what is driven the velocities are the means of the
  /// step.
  const CoursePart* drivenBy = nullptr;
  bool asleep = false;
  bool absent = false;  ///< a place that was left

  int partCount() const { return parts == nullptr ? 1 : static_cast<int>(parts->size()); }
  bool held() const { return drivenBy != nullptr; }
  bool isDriven() const { return held() && drivenBy != &kStillPart; }
  /// No force moves it in this step; and it is not driven either.
  bool still() const { return held() || asleep || absent; }
  bool stays() const { return still() && !isDriven(); }

  /// The principal axes, along which the inertia is diagonal, in the world.
  Mat3 principalAxes() const { return bodyFromPrincipal == nullptr ? axes : Mat3(axes * *bodyFromPrincipal); }
};

/// One box of a body where that is, or at that pose; of a half-space that.
PileBox boxOf(const PileBody& body, int box);
PileBox boxOf(const PileBody& body, int box, const Pose& pose);
/// use(boxA, boxB) of one box of each of two bodies.
template <class Use>
auto withBoxes(const PileBody& a, int boxA, const PileBody& b, int boxB, const Use& use) {
  return a.parts == nullptr && b.parts == nullptr
             ? use(static_cast<const PileBox&>(a), static_cast<const PileBox&>(b))
             : use(boxOf(a, boxA), boxOf(b, boxB));
}

/// `body`, or `wall`, must outlive it. A wall is held, and larger than any box; one that moves by itself is so
/// as from that time [s] on.
PileBody pileBody(const Body& body, const BodyState& state);
PileBody pileBody(const Wall& wall, double time = 0);
BodyState stateOf(const PileBody& body);

/// Puts what is driven where it is at a time [s].
void putDriven(PileBody& body, double time);

/// ω = A Ī⁻¹ Aᵀ L (Eq. 18).
void deriveOmega(PileBody& body);

/// At the same angular momentum.
void setAttitude(PileBody& body, const Quat& attitude);

/// Rotates a free body for h [s]: A ← A exp θ̃, L constant in the world frame.
///
/// θ is the Magnus series, truncated at fourth order, of Ȧ = A ω̃ with ω expanded about the start,
///     θ = h ω + h²/2 ω̇ + h³/6 ω̈ + h³/12 ω × ω̇,   ω̇ = Ī⁻¹(m × ω),   m = Aᵀ L, body frame:
/// local error O(h⁴). One evaluation, no trigonometric functions (the quaternion's two series are truncated
/// at θ¹⁰ and normalised). Rotations above half a radian are delegated to strangSteps.
///
/// Source: A. Iserles & S. P. Nørsett, Phil. Trans. R. Soc. A 357, 1999.
void turnFree(PileBody& body, double h);

/// [rad/s²] ω̇ = I⁻¹ (L × ω) of a free body with that ω, world.
Vec3 freeSpinRate(const PileBody& body, const Vec3& omega);

/// [rad/s] Body frame: of the turn from the one to the other in that time. Its angle is 2 asin of the length
/// of the vector part, here to eighth order.
Vec3 spinBetween(const Quat& from, const Quat& to, double length);

/// Rotates by a small rotation vector in the world frame, as the position projection does.
void turnBy(PileBody& body, const Vec3& rotation);

}  // namespace careen
