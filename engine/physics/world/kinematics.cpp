#include "physics/world/kinematics.h"

#include "core/math/rotation.h"

namespace careen {

Vec3 pointVelocity(const Vec3& centerVelocity, const Vec3& angularVelocity, const Vec3& r) {
  return centerVelocity + angularVelocity.cross(r);
}

Vec3 pointAcceleration(const Vec3& centerAcceleration, const Vec3& angularAcceleration,
                       const Vec3& angularVelocity, const Vec3& r) {
  return centerAcceleration + angularAcceleration.cross(r) + angularVelocity.cross(angularVelocity.cross(r));
}

Vec3 centerAcceleration(double inverseMass, const Vec3& totalForce) { return inverseMass * totalForce; }

Vec3 angularMomentumAbout(const Vec3& r, const Vec3& momentum) { return r.cross(momentum); }

Vec3 torqueAbout(const Vec3& r, const Vec3& force) { return r.cross(force); }

Mat3 inertia(std::span<const PointMass> points) {
  Mat3 sum = Mat3::Zero();
  for (const PointMass& point : points) {
    const Mat3 rTilde = tilde(point.r);
    sum -= point.mass * rTilde * rTilde;
  }
  return sum;
}

Vec3 angularMomentum(std::span<const PointMass> points, const Vec3& angularVelocity) {
  Vec3 sum = Vec3::Zero();
  for (const PointMass& point : points) {
    sum += angularMomentumAbout(point.r, point.mass * pointVelocity(Vec3::Zero(), angularVelocity, point.r));
  }
  return sum;
}

}  // namespace careen
