#pragma once

#include <cstddef>
#include <string>
#include <vector>

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

/// One of the boxes of a body. Its own frame has the body's origin, and axes along the edges of the box.
struct BodyPart {
  Vec3 halfExtents = Vec3::Zero();       ///< [m]
  Vec3 center = Vec3::Zero();            ///< [m] middle of the box, own frame
  bool turned = false;                   ///< its axes are not the body's
  Mat3 bodyFromPart = Mat3::Identity();  ///< [1] a rotation

  /// Its axes in the world, given the body's.
  Mat3 ownAxes(const Mat3& worldFromBody) const {
    return turned ? Mat3(worldFromBody * bodyFromPart) : worldFromBody;
  }
  /// [m] A corner, as in corner() below, and the middle of the box: body frame.
  Vec3 corner(int index) const;
  Vec3 middle() const { return turned ? Vec3(bodyFromPart * center) : center; }
  /// The same in a frame whose origin is there [m] in this body's.
  BodyPart seenFrom(const Vec3& origin) const;
  bool operator==(const BodyPart&) const = default;
};

/// A rigid body and the box, or the union of boxes, that it collides as. The body's frame has its origin at
/// the centre of mass; its axes lie along the box's edges, and the box's middle is the centre of mass unless
/// `boxCenter` says otherwise. Of several boxes that is the smallest box around all of them, along the body's
/// axes, about the point that the scene gives as the body's place.
struct Body {
  std::string name;
  Vec3 halfExtents = Vec3::Zero();  ///< [m] half sizes along the body's axes
  Vec3 boxCenter = Vec3::Zero();    ///< [m] middle of the box, body frame
  MassProperties mass;
  Material material;
  BodyState initial;
  Course course = {};                ///< of what is held and moves by itself
  std::vector<BodyPart> parts = {};  ///< none: the box is the body
  /// [m] Of the corners of its parts, body frame, those that may touch a half-space.
  std::vector<Vec3> partCorners = {};

  static constexpr std::size_t kMostParts = 256;  ///< what fits the key of a pair of boxes in a crowd

  int partCount() const { return parts.empty() ? 1 : static_cast<int>(parts.size()); }
  /// Of a body of several.
  const BodyPart& part(int index) const { return parts[static_cast<std::size_t>(index)]; }
  /// How many corner() knows.
  int cornerCount() const;
  /// [m] The smallest size of any box of it, halved.
  double thinnest() const;
};

/// Makes that body one of these boxes, with `halfExtents` about `boxCenter`. Of their corners those are left
/// out that lie within another one, or are listed twice. Each part's centre is given relative to the centre
/// of mass.
void setParts(Body& body, std::vector<BodyPart> parts);

/// What walls are where only the motion of a body counts: held, and without extent.
const Body& bodyOfWalls();

/// Corner 0…7 of a box, body frame [m]. Bit 2 of the index picks the sign of x, bit 1 of y, bit 0 of z; a
/// clear bit is plus.
inline Vec3 corner(const Vec3& halfExtents, int index) {
  const auto signOfBit = [index](int bit) { return (index & bit) == 0 ? 1.0 : -1.0; };
  return halfExtents.cwiseProduct(Vec3(signOfBit(4), signOfBit(2), signOfBit(1)));
}
inline constexpr int kCorners = 8;
inline int Body::cornerCount() const {
  return parts.empty() ? kCorners : static_cast<int>(partCorners.size());
}
/// Of a body of several boxes, one of `partCorners`.
inline Vec3 corner(const Body& body, int index) {
  return body.parts.empty() ? Vec3(body.boxCenter + corner(body.halfExtents, index))
                            : body.partCorners[static_cast<std::size_t>(index)];
}
inline Vec3 BodyPart::corner(int index) const {
  const Vec3 own = center + careen::corner(halfExtents, index);
  return turned ? Vec3(bodyFromPart * own) : own;
}
/// [m] From the centre of mass to the furthest corner of the box.
inline double radiusOf(const Body& body) { return (body.boxCenter.cwiseAbs() + body.halfExtents).norm(); }

/// Pose of the box, whose origin is its middle, given the body's; and back.
Pose boxPose(const Body& body, const Pose& pose);
Pose bodyPose(const Body& body, const Pose& box);
/// One of the boxes of a body: the pose of its middle, given that of the body's box; its half sizes [m].
Pose partPose(const Body& body, int part, const Pose& box);
const Vec3& partHalfExtents(const Body& body, int part);
/// [m/s] Velocity of the box's middle, given the body's state; and of the centre of mass, given the other.
Vec3 boxVelocity(const Body& body, const BodyState& state);
Vec3 bodyVelocity(const Body& body, const Mat3& worldFromBody, const Vec3& boxVelocity,
                  const Vec3& angularVelocity);

}  // namespace careen
