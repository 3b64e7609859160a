#include "physics/world/kinematics.h"

namespace careen {

Vec3 pointVelocity(const Vec3& centerVelocity, const Vec3& angularVelocity, const Vec3& r) {
  return centerVelocity + angularVelocity.cross(r);
}

Vec3 centerAcceleration(double inverseMass, const Vec3& totalForce) { return inverseMass * totalForce; }

Vec3 angularMomentumAbout(const Vec3& r, const Vec3& momentum) { return r.cross(momentum); }

Vec3 torqueAbout(const Vec3& r, const Vec3& force) { return r.cross(force); }

}  // namespace careen
