#include "physics/impact/single_impact.h"

#include <array>
#include <cmath>

#include "core/error.h"
#include "core/math/double_double.h"
#include "physics/geometry/contact_frame.h"

namespace careen {
namespace {

using Wide3 = std::array<DoubleDouble, 3>;

Wide3 wideCross(const Vec3& a, const Vec3& b) {
  return {twoProduct(a.y(), b.z()) - twoProduct(a.z(), b.y()),
          twoProduct(a.z(), b.x()) - twoProduct(a.x(), b.z()),
          twoProduct(a.x(), b.y()) - twoProduct(a.y(), b.x())};
}

Wide3 wideInBody(const Mat3& worldFromBody, const Wide3& v) {
  Wide3 result;
  for (Eigen::Index i = 0; i < 3; ++i) {
    result[static_cast<std::size_t>(i)] =
        worldFromBody(0, i) * v[0] + worldFromBody(1, i) * v[1] + worldFromBody(2, i) * v[2];
  }
  return result;
}

/// Contribution of one body to the contact.
struct Side {
  Wide3 torque;                       // arm × n, world: angular momentum per unit of normal impulse
  DoubleDouble speed;                 // n·(v + ω × arm)
  DoubleDouble inverseEffectiveMass;  // change of that speed per unit of normal impulse
};

Side sideOf(const ImpactBody& body, const Vec3& arm, const Vec3& normal) {
  const BodyState& state = *body.state;
  const MassProperties& mass = *body.mass;
  const Vec3& v = state.velocity;
  const Vec3& momentum = state.angularMomentum;
  Side side{wideCross(arm, normal), 0, 0};
  const Mat3 worldFromPrincipal = mass.worldFromPrincipal(state.pose.worldFromBody);
  const Wide3 torqueBody = wideInBody(worldFromPrincipal, side.torque);
  const Wide3 momentumBody = wideInBody(worldFromPrincipal, Wide3{momentum.x(), momentum.y(), momentum.z()});
  side.speed = twoProduct(normal.x(), v.x()) + twoProduct(normal.y(), v.y()) + twoProduct(normal.z(), v.z());
  // n·n differs from 1 by rounding, which would make the energy drift.
  side.inverseEffectiveMass =
      mass.inverseMass * (twoSquare(normal.x()) + twoSquare(normal.y()) + twoSquare(normal.z()));
  if (body.isDriven()) {  // n·(ω × arm) = ω·(arm × n)
    for (std::size_t i = 0; i < 3; ++i) {
      side.speed = side.speed + momentum[static_cast<Eigen::Index>(i)] * side.torque[i];
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const DoubleDouble spin = mass.inverseInertiaBody[static_cast<Eigen::Index>(i)] * torqueBody[i];
    side.speed = side.speed + spin * momentumBody[i];
    side.inverseEffectiveMass = side.inverseEffectiveMass + spin * torqueBody[i];
  }
  return side;
}

/// Applies an impulse at the end of an arm to v and L of a body: `alongNormal` n, and a small remainder in
/// plain doubles.
void push(const ImpactBody& body, const Side& side, const Vec3& normal, const DoubleDouble& alongNormal) {
  BodyState& state = *body.state;
  const DoubleDouble perMass = body.mass->inverseMass * alongNormal;
  const bool turns = !body.mass->inverseInertiaBody.isZero(0);
  for (Eigen::Index k = 0; k < 3; ++k) {
    state.velocity[k] = static_cast<double>(state.velocity[k] + normal[k] * perMass);
    if (turns) {
      state.angularMomentum[k] = static_cast<double>(state.angularMomentum[k] +
                                                     alongNormal * side.torque[static_cast<std::size_t>(k)]);
    }
  }
}

void push(const ImpactBody& body, const Vec3& arm, const Vec3& impulse) {
  body.state->velocity += body.mass->inverseMass * impulse;
  if (!body.mass->inverseInertiaBody.isZero(0)) {
    body.state->angularMomentum += arm.cross(impulse);
  }
}

/// Velocity of the body's point at `arm` after `impulse` there, starting from rest.
Vec3 yield(const ImpactBody& body, const Vec3& arm, const Vec3& impulse) {
  const Mat3& a = body.state->pose.worldFromBody;
  const Vec3 torqueBody = a.transpose() * arm.cross(impulse);
  const Vec3 spin = a * body.mass->inverseInertiaTimes(torqueBody);
  return body.mass->inverseMass * impulse + spin.cross(arm);
}

Vec3 pointVelocity(const ImpactBody& body, const Vec3& arm) {
  if (isImmovable(*body.mass)) {
    return body.state->velocity + body.state->angularMomentum.cross(arm);
  }
  const Mat3& a = body.state->pose.worldFromBody;
  const Vec3 momentumBody = a.transpose() * body.state->angularMomentum;
  const Vec3 spin = a * body.mass->inverseInertiaTimes(momentumBody);
  return body.state->velocity + spin.cross(arm);
}

/// The tangential problem of one contact, in the plane of the tangents.
struct Plane {
  double x = 0;
  double y = 0;
};
struct Slip {
  Plane speed;    // s: slip velocity at the end of compression, without friction
  double xx = 0;  // B: slip per unit of tangential impulse, while the normal speed is kept
  double xy = 0;
  double yy = 0;
  Plane coupling;            // a: normal impulse lost per unit of tangential impulse
  double normalImpulse = 0;  // N: without friction
};

/// j = −(B + γ)⁻¹ s.
Plane impulseAt(const Slip& slip, double gamma) {
  const double xx = slip.xx + gamma;
  const double yy = slip.yy + gamma;
  const double det = xx * yy - slip.xy * slip.xy;
  return {.x = -(yy * slip.speed.x - slip.xy * slip.speed.y) / det,
          .y = -(xx * slip.speed.y - slip.xy * slip.speed.x) / det};
}

double limitAt(const Slip& slip, double friction, const Plane& j) {
  return friction * (slip.normalImpulse - (slip.coupling.x * j.x + slip.coupling.y * j.y));
}

/// Minimises the energy ½ jᵀBj + sᵀj within the friction cone: stick if that is inside the cone, otherwise j
/// = −(B + γ)⁻¹ s with γ ≥ 0 where |j| reaches the limit, opposite to the remaining slip B j + s. By
/// bisection, because the limit varies with j and Newton's method could leave the root that continues the
/// frictionless law.
Plane frictionImpulse(const Slip& slip, double friction) {
  const auto outside = [&](const Plane& j) {
    return std::sqrt(j.x * j.x + j.y * j.y) > limitAt(slip, friction, j);
  };
  const Plane stick = impulseAt(slip, 0);
  if (!outside(stick)) {
    return stick;
  }
  double inside = slip.xx + slip.yy;
  for (int i = 0; i < 1000 && outside(impulseAt(slip, inside)); ++i) {
    inside *= 2;
  }
  double out = 0;
  for (int i = 0; i < 1000; ++i) {
    const double middle = out + (inside - out) / 2;
    if (!(middle > out && middle < inside)) {
      break;
    }
    (outside(impulseAt(slip, middle)) ? out : inside) = middle;
  }
  return impulseAt(slip, inside);
}

Slip slipOf(const ImpactBody& a, const ImpactBody* b, const ImpactContact& contact, const ContactFrame& frame,
            double inverseEffectiveMass, double approach) {
  const Vec3& n = contact.normal;
  Vec3 velocity = pointVelocity(a, contact.armA);
  Vec3 byNormal = yield(a, contact.armA, n);
  Vec3 byFirst = yield(a, contact.armA, frame.tangent1);
  Vec3 bySecond = yield(a, contact.armA, frame.tangent2);
  if (b != nullptr) {
    velocity -= pointVelocity(*b, contact.armB);
    byNormal += yield(*b, contact.armB, n);
    byFirst += yield(*b, contact.armB, frame.tangent1);
    bySecond += yield(*b, contact.armB, frame.tangent2);
  }
  if (contact.material.surface.moves()) {
    velocity -= contact.material.surface.along(n, a.state->pose.position + contact.armA);
  }
  const Plane across{.x = dot(byNormal, frame.tangent1), .y = dot(byNormal, frame.tangent2)};
  const double compression = approach / inverseEffectiveMass;
  Slip slip;
  slip.coupling = {.x = across.x / inverseEffectiveMass, .y = across.y / inverseEffectiveMass};
  slip.speed = {.x = dot(velocity, frame.tangent1) + across.x * compression,
                .y = dot(velocity, frame.tangent2) + across.y * compression};
  slip.xx = dot(byFirst, frame.tangent1) - across.x * slip.coupling.x;
  slip.xy = dot(byFirst, frame.tangent2) - across.x * slip.coupling.y;
  slip.yy = dot(bySecond, frame.tangent2) - across.y * slip.coupling.y;
  slip.normalImpulse = (1 + contact.material.restitution) * compression;
  return slip;
}

}  // namespace

ImpactShare resolveSingleImpact(const ImpactBody& a, const ImpactBody* b, const ImpactContact& contact) {
  const Vec3& n = contact.normal;
  const Side sideA = sideOf(a, contact.armA, n);
  Side sideB{};
  DoubleDouble speed = sideA.speed;
  DoubleDouble inverseEffectiveMass = sideA.inverseEffectiveMass;
  if (b != nullptr) {
    sideB = sideOf(*b, contact.armB, n);
    speed = speed - sideB.speed;
    inverseEffectiveMass = inverseEffectiveMass + sideB.inverseEffectiveMass;
  }
  speed = normalized(speed);  // its terms may have cancelled
  inverseEffectiveMass = normalized(inverseEffectiveMass);
  ImpactShare share{.approach = -speed.hi, .impulse = 0, .tangential = 0};
  if (!(speed.hi < 0)) {
    if (!std::isfinite(speed.hi)) {
      throw NumericalError("impact: a velocity or an arm is not a finite number");
    }
    return share;
  }
  if (!(inverseEffectiveMass.hi > 0)) {
    throw NumericalError("impact: neither side can move");
  }
  const DoubleDouble impulse =
      normalized(-(twoSum(1, contact.material.restitution) * speed) / inverseEffectiveMass);
  if (!std::isfinite(impulse.hi)) {
    throw NumericalError("impact: the impulse is not a finite number");
  }
  share.impulse = impulse.hi;

  Vec3 frictional = Vec3::Zero();
  if (contact.material.friction > 0) {
    const ContactFrame frame = frameOf(n);
    const Slip slip = slipOf(a, b, contact, frame, inverseEffectiveMass.hi, share.approach);
    const Plane j = frictionImpulse(slip, contact.material.friction);
    const double normalPart = -(slip.coupling.x * j.x + slip.coupling.y * j.y);
    frictional = frame.across(j.x, j.y) + normalPart * n;
    share.impulse += normalPart;
    share.tangential = std::sqrt(j.x * j.x + j.y * j.y);
  }
  push(a, sideA, n, impulse);
  if (b != nullptr) {
    push(*b, sideB, n, -impulse);
  }
  if (contact.material.friction > 0) {
    push(a, contact.armA, frictional);
    if (b != nullptr) {
      push(*b, contact.armB, -frictional);
    }
  }
  return share;
}

}  // namespace careen
