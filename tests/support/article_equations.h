#pragma once

#include <cmath>
#include <vector>

#include "core/math/rotation.h"
#include "physics/world/kinematics.h"

// Equations of the article this project grew from that the engine does not evaluate: it has them in closed
// form, or in another form. The tests compare with them. Those that the engine evaluates are in
// core/math/rotation.h, physics/world/body.h and physics/world/kinematics.h.
//
// Rotations by an angle use the library's sine and cosine, whose last bits are not guaranteed; rotationAbout
// of stage/turn.h has the same bits everywhere.

namespace careen {

/// r decomposed about a unit axis n: r = along + radial, and ahead = n × r completes the right-handed frame
/// in which r rotates (Eqs. 3–5).
struct AxisDecomposition {
  Vec3 along;   ///< o = (nᵀr) n
  Vec3 radial;  ///< x = r − o
  Vec3 ahead;   ///< y = n × r
};
inline AxisDecomposition decomposeAboutAxis(const Vec3& unitAxis, const Vec3& r) {
  const Vec3 along = unitAxis.dot(r) * unitAxis;
  return {.along = along, .radial = r - along, .ahead = unitAxis.cross(r)};
}

/// r rotated about a unit axis by `angle` [rad] (Eq. 6).
inline Vec3 rotateAboutAxis(const Vec3& unitAxis, double angle, const Vec3& r) {
  const AxisDecomposition parts = decomposeAboutAxis(unitAxis, r);
  return parts.along + std::cos(angle) * parts.radial + std::sin(angle) * parts.ahead;
}

/// Rotation matrix of rotateAboutAxis: Eq. 6 with r factored out.
inline Mat3 axisAngle(const Vec3& unitAxis, double angle) {
  const Mat3 along = unitAxis * unitAxis.transpose();
  return along + std::cos(angle) * (Mat3::Identity() - along) + std::sin(angle) * tilde(unitAxis);
}

/// b̈ = ö + α × r + ω × (ω × r) (Eq. 13), [m/s²]. The last term is the centripetal one.
inline Vec3 pointAcceleration(const Vec3& centerAcceleration, const Vec3& angularAcceleration,
                              const Vec3& angularVelocity, const Vec3& r) {
  return centerAcceleration + angularAcceleration.cross(r) + angularVelocity.cross(angularVelocity.cross(r));
}

struct PointMass {
  double mass = 0;        ///< [kg]
  Vec3 r = Vec3::Zero();  ///< [m] from the centre of mass
};

/// I = Σ −mᵢ r̃ᵢ r̃ᵢ, [kg m²]: Eq. 17 in world coordinates, Eq. 19 in the body's. For a solid box the sum
/// becomes an integral, which solidBox has in closed form.
inline Mat3 inertia(const std::vector<PointMass>& points) {
  Mat3 sum = Mat3::Zero();
  for (const PointMass& point : points) {
    const Mat3 rTilde = tilde(point.r);
    sum -= point.mass * rTilde * rTilde;
  }
  return sum;
}

/// L = Σ rᵢ × mᵢ (ω × rᵢ), [kg m²/s]: equals I ω by Eq. 17; here before ω is factored out.
inline Vec3 angularMomentum(const std::vector<PointMass>& points, const Vec3& angularVelocity) {
  Vec3 sum = Vec3::Zero();
  for (const PointMass& point : points) {
    sum += angularMomentumAbout(point.r, point.mass * pointVelocity(Vec3::Zero(), angularVelocity, point.r));
  }
  return sum;
}

}  // namespace careen
