#pragma once

#include <string>

#include "core/math/linear_algebra.h"
#include "core/math/pose.h"
#include "physics/world/course.h"

namespace careen {

/// Mass and inertia of a body. Infinite mass is inverse mass 0; mass and inertia are then 0 as well, so that
/// the weight and energy of an immovable body are zero.
struct MassProperties {
  double mass = 0;                  ///< [kg]
  double inverseMass = 0;           ///< [1/kg]
  Vec3 inertiaBody = Vec3::Zero();  ///< [kg m²] principal moments of Ī about the centre of mass (Eq. 19)
  Vec3 inverseInertiaBody = Vec3::Zero();     ///< [1/(kg m²)] of Ī⁻¹
  bool turned = false;                        ///< the principal axes are not the body's
  Mat3 bodyFromPrincipal = Mat3::Identity();  ///< [1] a rotation whose columns are the principal axes

  /// Ī v and Ī⁻¹ v, body frame.
  Vec3 inertiaTimes(const Vec3& v) const {
    return turned ? Vec3(bodyFromPrincipal * inertiaBody.cwiseProduct(bodyFromPrincipal.transpose() * v))
                  : Vec3(inertiaBody.cwiseProduct(v));
  }
  Vec3 inverseInertiaTimes(const Vec3& v) const {
    return turned
               ? Vec3(bodyFromPrincipal * inverseInertiaBody.cwiseProduct(bodyFromPrincipal.transpose() * v))
               : Vec3(inverseInertiaBody.cwiseProduct(v));
  }
  /// [kg m²] Ī, body frame.
  Mat3 inertiaTensor() const {
    return bodyFromPrincipal * inertiaBody.asDiagonal() * bodyFromPrincipal.transpose();
  }
  /// A vector along the principal axes, given along the body's, and back.
  Vec3 toPrincipal(const Vec3& v) const { return turned ? Vec3(bodyFromPrincipal.transpose() * v) : v; }
  Vec3 fromPrincipal(const Vec3& v) const { return turned ? Vec3(bodyFromPrincipal * v) : v; }
  /// Attitude of the principal axes, given the body's, and back.
  Mat3 worldFromPrincipal(const Mat3& worldFromBody) const {
    return turned ? Mat3(worldFromBody * bodyFromPrincipal) : worldFromBody;
  }
  Quat worldFromPrincipal(const Quat& worldFromBody) const {
    return turned ? worldFromBody * Quat(bodyFromPrincipal) : worldFromBody;
  }
  Quat worldFromBody(const Quat& worldFromPrincipal) const {
    return turned ? worldFromPrincipal * Quat(bodyFromPrincipal).conjugate() : worldFromPrincipal;
  }

  bool operator==(const MassProperties&) const = default;
};

/// Solid box of constant density with full sizes (a,b,c): Ī = M/12 diag(b²+c², a²+c², a²+b²), Eq. 19
/// integrated. Sizes [m] and mass [kg] must be positive and finite, else InputError.
MassProperties solidBox(const Vec3& halfExtents, double mass);
/// A wall, or a fixed body: no impulse moves it.
MassProperties immovable();
inline bool isImmovable(const MassProperties& mass) { return mass.inverseMass == 0; }

/// How a surface moves along itself, though what it belongs to is held: a belt, or a turntable. Friction aims
/// at it.
struct SurfaceMotion {
  Vec3 velocity = Vec3::Zero();  ///< [m/s] of what passes the world's origin
  Vec3 spin = Vec3::Zero();      ///< [rad/s]

  bool moves() const { return !velocity.isZero(0) || !spin.isZero(0); }
  /// [m/s] At a point of the world, along a surface with that normal.
  Vec3 along(const Vec3& normal, const Vec3& point) const {
    const Vec3 all = velocity + spin.cross(point);
    return all - dot(normal, all) * normal;
  }
};

/// Contact material. A pair has restitution max(e₁, e₂) and friction sqrt(μ₁ μ₂).
struct Material {
  double restitution = 0;      ///< [1] 0 … 1
  double friction = 0;         ///< [1] Coulomb friction coefficient μ
  SurfaceMotion surface = {};  ///< of what is held; of a pair, that of b as seen from a
};
Material touching(const Material& a, const Material& b);
/// The same pair, the other way round.
Material swapped(const Material& pair);

/// State of one body, world frame. L, not ω, is the primary state: torque integrates to it, and a free body
/// conserves it. What is held has no L: it has its ω there, as if its inertia were 1 kg m².
struct BodyState {
  Pose pose = {};
  Vec3 velocity = Vec3::Zero();         ///< [m/s] of the centre of mass
  Vec3 angularMomentum = Vec3::Zero();  ///< [kg m²/s] about the centre of mass
};

BodyState stateOf(const Kinematics& driven);

/// I⁻¹ = A Ī⁻¹ Aᵀ (Eq. 20), a similarity transform.
Mat3 inverseInertiaWorld(const MassProperties& mass, const Mat3& worldFromBody);
/// ω = I⁻¹ L (Eq. 18), [rad/s].
Vec3 angularVelocity(const MassProperties& mass, const BodyState& state);
/// L = I ω (Eq. 17), [kg m²/s].
Vec3 angularMomentum(const MassProperties& mass, const Mat3& worldFromBody, const Vec3& angularVelocity);

/// ½ M v² + ½ ω·L, [J]; 0 for immovable bodies.
double kineticEnergy(const MassProperties& mass, const BodyState& state);

/// A rigid body and the box that it collides as. The body's frame has its origin at the centre of mass and
/// its axes along the box's edges; the box's middle is the centre of mass unless `boxCenter` says otherwise.
struct Body {
  std::string name;
  Vec3 halfExtents = Vec3::Zero();  ///< [m] half sizes along the body's axes
  Vec3 boxCenter = Vec3::Zero();    ///< [m] middle of the box, body frame
  MassProperties mass;
  Material material;
  BodyState initial;
  Course course = {};  ///< of what is held and moves by itself
};

/// What walls are where only the motion of a body counts: held, and without extent.
const Body& bodyOfWalls();

/// Corner 0…7 of a box, body frame [m]. Bit 2 of the index picks the sign of x, bit 1 of y, bit 0 of z; a
/// clear bit is plus.
inline Vec3 corner(const Vec3& halfExtents, int index) {
  const auto signOfBit = [index](int bit) { return (index & bit) == 0 ? 1.0 : -1.0; };
  return halfExtents.cwiseProduct(Vec3(signOfBit(4), signOfBit(2), signOfBit(1)));
}
inline constexpr int kCorners = 8;
inline Vec3 corner(const Body& body, int index) { return body.boxCenter + corner(body.halfExtents, index); }
/// [m] From the centre of mass to the box's furthest corner.
inline double radiusOf(const Body& body) { return (body.boxCenter.cwiseAbs() + body.halfExtents).norm(); }

/// Pose of the box, whose origin is its middle, given the body's; and back.
Pose boxPose(const Body& body, const Pose& pose);
Pose bodyPose(const Body& body, const Pose& box);
/// [m/s] Velocity of the box's middle, given the body's state; and of the centre of mass, given the other.
Vec3 boxVelocity(const Body& body, const BodyState& state);
Vec3 bodyVelocity(const Body& body, const Mat3& worldFromBody, const Vec3& boxVelocity,
                  const Vec3& angularVelocity);

}  // namespace careen
