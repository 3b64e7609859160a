#include "physics/mover.h"

#include <algorithm>

#include "physics/separation.h"

namespace careen {

void Mover::fly(const BodyState& state, const Quat& attitude, const Vec3& gravity) {
  flies = true;
  flight = {.position = state.pose.position,
            .velocity = state.velocity,
            .acceleration = gravity,
            .worldFromBody = attitude,
            .angularMomentum = state.angularMomentum};
  if (!moments) {
    moments.emplace(body->mass.inertiaBody);
  }
  rotation.emplace(*moments, attitude, state.angularMomentum);
  const TorqueFreeRotation<double>::Bounds& bounds = rotation->bounds();
  angularSpeedBound = bounds.angularSpeed;
  angularAccelerationBound = bounds.angularAcceleration;
}

void Mover::rest(const Pose& at) {
  flies = false;
  flight = {.position = at.position, .worldFromBody = Quat(at.worldFromBody)};
  pose = at;
  rotation.reset();
  angularSpeedBound = 0;
  angularAccelerationBound = 0;
  wall.reset();
  crosses = false;
  crossing = {};
}

Quat Mover::attitudeAt(const Instant& time) const {
  return rotation ? rotation->worldFromBody(elapsed(time)) : flight.worldFromBody;
}

BodyState Mover::stateAt(const Instant& time, const Quat& attitude) const {
  if (!flies) {
    return {.pose = pose};
  }
  const double since = elapsed(time);
  return {.pose = {.position = flight.positionAt(since), .worldFromBody = attitude.toRotationMatrix()},
          .velocity = flight.velocityAt(since),
          .angularMomentum = flight.angularMomentum};
}

Attitude Mover::operator()(double elapsed) const {
  if (!rotation) {
    return {.worldFromBody = pose.worldFromBody};
  }
  const Quat attitude = rotation->worldFromBody(elapsed);
  return {.worldFromBody = attitude.toRotationMatrix(),
          .angularVelocity = rotation->angularVelocityWorld(attitude)};
}

MovingBox Mover::moving(const Instant& clockZero) const {
  return {.halfExtents = body->halfExtents,
          .position = flight.position,
          .velocity = flight.velocity,
          .acceleration = flight.acceleration,
          .age = elapsed(clockZero),
          .angularSpeedBound = angularSpeedBound,
          .angularAccelerationBound = angularAccelerationBound,
          .attitude = AttitudeView(*this)};
}

bool touch(const Mover& a, const Mover& b, const Instant& time) {
  const double radiusA = a.body->halfExtents.norm();
  const double radiusB = b.body->halfExtents.norm();
  const Vec3 positionA = a.flight.positionAt(a.elapsed(time));
  const Vec3 positionB = b.flight.positionAt(b.elapsed(time));
  const double within =
      touchingWithin(std::min(radiusA, radiusB),
                     positionA.cwiseAbs().sum() + positionB.cwiseAbs().sum() + radiusA + radiusB);
  const Vec3 bToA = positionA - positionB;
  if (bToA.norm() > radiusA + radiusB + within) {
    return false;
  }
  return BoxAxes(a.stateAt(time).pose.worldFromBody, a.body->halfExtents, b.stateAt(time).pose.worldFromBody,
                 b.body->halfExtents, bToA)
             .gap() <= within;
}

}  // namespace careen
