#include "physics/world/body.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/math/rotation.h"

namespace careen {

MassProperties solidBox(const Vec3& halfExtents, double mass) {
  const auto isUsable = [](double value) { return std::isfinite(value) && value > 0; };
  if (!(isUsable(mass) && std::all_of(halfExtents.begin(), halfExtents.end(), isUsable))) {
    throw InputError("a solid box needs positive, finite sizes and mass");
  }
  const Vec3 squares = halfExtents.cwiseAbs2();
  // With half sizes, 1/12 becomes 1/3.
  const Vec3 inertia =
      mass / 3 * Vec3(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y());
  return {.mass = mass,
          .inverseMass = 1 / mass,
          .inertiaBody = inertia,
          .inverseInertiaBody = inertia.cwiseInverse()};
}

MassProperties immovable() { return {}; }

const Body& bodyOfWalls() {
  static const Body held{};  // with the mass of immovable()
  return held;
}

Material touching(const Material& a, const Material& b) {
  return {.restitution = std::max(a.restitution, b.restitution),
          .friction = std::sqrt(a.friction * b.friction),
          .surface = {.velocity = b.surface.velocity - a.surface.velocity,
                      .spin = b.surface.spin - a.surface.spin}};
}

Material swapped(const Material& pair) {
  Material other = pair;
  other.surface = {.velocity = -pair.surface.velocity, .spin = -pair.surface.spin};
  return other;
}

namespace {

/// [1] Of its size: corners within a box by less are on its surface, and nearer to each other are one.
constexpr double kOnSurface = 0x1p-40;

bool isWithin(const BodyPart& part, const Vec3& point) {
  const Vec3 own = (part.turned ? Vec3(part.bodyFromPart.transpose() * point) : point) - part.center;
  const double surface = kOnSurface * (part.halfExtents.norm() + part.center.norm());
  return (own.cwiseAbs().array() < part.halfExtents.array() - surface).all();
}

}  // namespace

BodyPart BodyPart::seenFrom(const Vec3& origin) const {
  BodyPart moved = *this;
  moved.center -= turned ? Vec3(bodyFromPart.transpose() * origin) : origin;
  return moved;
}

double Body::thinnest() const {
  if (parts.empty()) {
    return halfExtents.minCoeff();
  }
  double thinnest = parts.front().halfExtents.minCoeff();
  for (const BodyPart& part : parts) {
    thinnest = std::min(thinnest, part.halfExtents.minCoeff());
  }
  return thinnest;
}

void setParts(Body& body, std::vector<BodyPart> parts) {
  body.parts = std::move(parts);
  body.partCorners.clear();
  body.halfExtents = Vec3::Zero();
  for (const BodyPart& part : body.parts) {
    for (int k = 0; k < kCorners; ++k) {
      const Vec3 corner = part.corner(k);
      body.halfExtents = body.halfExtents.cwiseMax((corner - body.boxCenter).cwiseAbs());
      const bool isCovered =
          std::any_of(body.parts.begin(), body.parts.end(),
                      [&](const BodyPart& other) { return isWithin(other, corner); }) ||
          std::any_of(body.partCorners.begin(), body.partCorners.end(), [&](const Vec3& other) {
            return (other - corner).norm() <= kOnSurface * (corner.norm() + part.halfExtents.norm());
          });
      if (!isCovered) {
        body.partCorners.push_back(corner);
      }
    }
  }
}

Mat3 inverseInertiaWorld(const MassProperties& mass, const Mat3& worldFromBody) {
  const Mat3 inverse = mass.inverseInertiaBody.asDiagonal();
  return similarityTransform(mass.worldFromPrincipal(worldFromBody), inverse);
}

BodyState stateOf(const Kinematics& driven) {
  return {.pose = driven.pose, .velocity = driven.velocity, .angularMomentum = driven.angularVelocity};
}

// Eqs. 18 and 17 through Eq. 20, evaluated right to left: three matrix-vector products instead of two of
// matrices.
Vec3 angularVelocity(const MassProperties& mass, const BodyState& state) {
  if (isImmovable(mass)) {
    return state.angularMomentum;
  }
  const Mat3& worldFromBody = state.pose.worldFromBody;
  const Vec3 momentumBody = worldFromBody.transpose() * state.angularMomentum;
  return worldFromBody * mass.inverseInertiaTimes(momentumBody);
}

Vec3 angularMomentum(const MassProperties& mass, const Mat3& worldFromBody, const Vec3& angularVelocity) {
  if (isImmovable(mass)) {
    return angularVelocity;
  }
  const Vec3 velocityBody = worldFromBody.transpose() * angularVelocity;
  return worldFromBody * mass.inertiaTimes(velocityBody);
}

double kineticEnergy(const MassProperties& mass, const BodyState& state) {
  return isImmovable(mass) ? 0
                           : 0.5 * mass.mass * state.velocity.squaredNorm() +
                                 0.5 * dot(angularVelocity(mass, state), state.angularMomentum);
}

Pose boxPose(const Body& body, const Pose& pose) {
  return body.boxCenter.isZero(0) ? pose : Pose{pose.worldPoint(body.boxCenter), pose.worldFromBody};
}

Pose bodyPose(const Body& body, const Pose& box) {
  return body.boxCenter.isZero(0) ? box : Pose{box.worldPoint(-body.boxCenter), box.worldFromBody};
}

Pose partPose(const Body& body, int part, const Pose& box) {
  if (body.parts.empty()) {
    return box;
  }
  const BodyPart own = body.part(part).seenFrom(body.boxCenter);
  return {box.worldPoint(own.middle()), own.ownAxes(box.worldFromBody)};
}

const Vec3& partHalfExtents(const Body& body, int part) {
  return body.parts.empty() ? body.halfExtents : body.part(part).halfExtents;
}

Vec3 boxVelocity(const Body& body, const BodyState& state) {
  return body.boxCenter.isZero(0)
             ? state.velocity
             : Vec3(state.velocity +
                    angularVelocity(body.mass, state).cross(state.pose.worldFromBody * body.boxCenter));
}

Vec3 bodyVelocity(const Body& body, const Mat3& worldFromBody, const Vec3& boxVelocity,
                  const Vec3& angularVelocity) {
  return body.boxCenter.isZero(0) ? boxVelocity
                                  : Vec3(boxVelocity - angularVelocity.cross(worldFromBody * body.boxCenter));
}

}  // namespace careen
