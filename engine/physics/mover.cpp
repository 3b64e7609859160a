#include "physics/mover.h"

#include <algorithm>
#include <utility>

#include "physics/separation.h"

namespace careen {

int Touchers::leader() const {
  std::size_t first = 0;
  while (island.bodies()[first].isHeld()) {
    ++first;
  }
  return ranks[first];
}

void Mover::fly(const BodyState& state, const Quat& attitude, const Vec3& gravity) {
  flies = true;
  touchers.reset();
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

void Mover::touch(std::shared_ptr<Touchers> with, std::size_t as) {
  rest({});
  touchers = std::move(with);
  place = as;
}

void Mover::rest(const Pose& at) {
  flies = false;
  touchers.reset();
  flight = {.position = at.position, .worldFromBody = Quat(at.worldFromBody)};
  pose = at;
  rotation.reset();
  angularSpeedBound = 0;
  angularAccelerationBound = 0;
  wall.reset();
  crosses = false;
  crossing = {};
}

Vec3 Mover::positionAt(const Instant& time) const {
  return touches() ? stateAt(time).pose.position : flight.positionAt(elapsed(time));
}

Quat Mover::attitudeAt(const Instant& time) const {
  if (touches()) {
    return Quat(careen::stateAt(touchers->motions[place], body->mass, elapsed(time)).pose.worldFromBody);
  }
  return rotation ? rotation->worldFromBody(elapsed(time)) : flight.worldFromBody;
}

BodyState Mover::stateAt(const Instant& time, const Quat& attitude) const {
  if (touches()) {
    return careen::stateAt(touchers->motions[place], body->mass, elapsed(time));
  }
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

bool areTouching(const Body& a, const Pose& poseA, const Body& b, const Pose& poseB) {
  const double radiusA = a.halfExtents.norm();
  const double radiusB = b.halfExtents.norm();
  const double within =
      touchingWithin(std::min(radiusA, radiusB),
                     poseA.position.cwiseAbs().sum() + poseB.position.cwiseAbs().sum() + radiusA + radiusB);
  const Vec3 bToA = poseA.position - poseB.position;
  if (bToA.norm() > radiusA + radiusB + within) {
    return false;
  }
  return BoxAxes(poseA.worldFromBody, a.halfExtents, poseB.worldFromBody, b.halfExtents, bToA).gap() <=
         within;
}

}  // namespace careen
