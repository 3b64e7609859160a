#include "physics/compared/impulse.h"

#include "physics/world/kinematics.h"

namespace careen {
namespace {

Vec3 velocityAt(const CollidingBody& body, const Vec3& point) {
  return pointVelocity(body.state.velocity, angularVelocity(body.mass, body.state),
                       point - body.state.pose.position);
}

// (I⁻¹ (r×n)) × r · n: rotational part of the inverse effective mass.
double turningTerm(const CollidingBody& body, const Vec3& point, const Vec3& normal) {
  const Vec3 r = point - body.state.pose.position;
  const Mat3 inverseInertia = inverseInertiaWorld(body.mass, body.state.pose.worldFromBody);
  return dot((inverseInertia * r.cross(normal)).cross(r), normal);
}

}  // namespace

double normalVelocity(const CollidingBody& a, const CollidingBody& b, const Vec3& point, const Vec3& normal) {
  return dot(velocityAt(a, point) - velocityAt(b, point), normal);
}

double collisionImpulse(const CollidingBody& a, const CollidingBody& b, const Vec3& point, const Vec3& normal,
                        double restitution) {
  const double inverseMasses = a.mass.inverseMass + b.mass.inverseMass;
  const double yielding =
      dot(normal, normal) * inverseMasses + turningTerm(a, point, normal) + turningTerm(b, point, normal);
  return -(1 + restitution) * normalVelocity(a, b, point, normal) / yielding;
}

void applyImpulse(const CollidingBody& body, const Vec3& point, const Vec3& impulse) {
  body.state.velocity += body.mass.inverseMass * impulse;
  if (!isImmovable(body.mass)) {
    body.state.angularMomentum += angularMomentumAbout(point - body.state.pose.position, impulse);
  }
}

double impactEnergyChange(double approach, double impulse, double restitution) {
  return -0.5 * (1 - restitution) * impulse * approach;
}

}  // namespace careen
