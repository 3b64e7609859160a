#include "physics/exact/mover.h"

#include <algorithm>
#include <utility>

#include "physics/contact/contact_feature.h"
#include "physics/geometry/separation.h"

namespace careen {

void Mover::fly(const BodyState& state, const Quat& attitude, const Vec3& gravity, const Vec3& jerk) {
  kind = Kind::kFlies;
  group.reset();
  flight = {.position = state.pose.position,
            .velocity = state.velocity,
            .acceleration = gravity,
            .worldFromBody = attitude,
            .angularMomentum = state.angularMomentum,
            .jerk = jerk};
  if (!moments) {
    moments.emplace(body->mass.inertiaBody);
  }
  rotation.emplace(*moments, body->mass.worldFromPrincipal(attitude), state.angularMomentum);
  const TorqueFreeRotation<double>::Bounds& turning = rotation->bounds();
  bounds.angularSpeed = turning.angularSpeed;
  bounds.angularAcceleration = turning.angularAcceleration;
}

void Mover::step(std::shared_ptr<ContactGroup> with, std::size_t as) {
  rest({});
  kind = Kind::kSteps;
  group = std::move(with);
  place = as;
  bounds = boundsOf(group->motion(place));
}

void Mover::drive(const CoursePart& by) {
  rest({});
  kind = Kind::kDriven;
  drivenBy = &by;
  bounds = boundsOf(by.motion);
}

void Mover::rest(const Pose& at) {
  kind = Kind::kRests;
  flight = {.position = at.position, .worldFromBody = Quat(at.worldFromBody)};
  pose = at;
  rotation.reset();
  bounds = {};
  wall.reset();
  crosses = false;
  crossing = {};
}

Vec3 Mover::positionAt(const Instant& time) const {
  if (isDriven()) {
    return drivenBy->motion.at(elapsed(time)).pose.position;
  }
  return steps() ? careen::positionAt(group->motion(place), elapsed(time)) : flight.positionAt(elapsed(time));
}

Quat Mover::attitudeAt(const Instant& time) const {
  if (steps()) {
    return Quat(careen::stateAt(group->motion(place), body->mass, elapsed(time)).pose.worldFromBody);
  }
  if (isDriven()) {
    return Quat(drivenBy->motion.at(elapsed(time)).pose.worldFromBody);
  }
  return rotation ? body->mass.worldFromBody(rotation->worldFromBody(elapsed(time))) : flight.worldFromBody;
}

BodyState Mover::stateAt(const Instant& time, const Quat& attitude) const {
  if (steps()) {
    return careen::stateAt(group->motion(place), body->mass, elapsed(time));
  }
  if (isDriven()) {
    return stateOf(drivenBy->motion.at(elapsed(time)));
  }
  if (!flies()) {
    return {.pose = pose};
  }
  const double since = elapsed(time);
  return {.pose = {.position = flight.positionAt(since), .worldFromBody = attitude.toRotationMatrix()},
          .velocity = flight.velocityAt(since),
          .angularMomentum = flight.angularMomentum};
}

Attitude Mover::operator()(double elapsed) const {
  if (steps()) {
    const BodyState state = careen::stateAt(group->motion(place), body->mass, elapsed);
    return {.worldFromBody = state.pose.worldFromBody, .angularVelocity = angularVelocity(body->mass, state)};
  }
  if (isDriven()) {
    const Kinematics now = drivenBy->motion.at(elapsed);
    return {.worldFromBody = now.pose.worldFromBody, .angularVelocity = now.angularVelocity};
  }
  if (!rotation) {
    return {.worldFromBody = pose.worldFromBody};
  }
  const Quat principal = rotation->worldFromBody(elapsed);
  return {.worldFromBody = body->mass.worldFromBody(principal).toRotationMatrix(),
          .angularVelocity = rotation->angularVelocityWorld(principal)};
}

MovingBox Mover::moving(const Instant& clockZero, int box, const Instant& foreseen) const {
  const TouchingShape shape = shapeOf(*body, box);
  return {.halfExtents = shape.halfExtents,
          .center = shape.center,
          .bodyFromBox = shape.bodyFromBox,
          .position = flight.position,
          .velocity = flight.velocity,
          .acceleration = flight.acceleration,
          .age = elapsed(clockZero),
          .angularSpeedBound = bounds.angularSpeed,
          .angularAccelerationBound = bounds.angularAcceleration,
          .attitude = AttitudeView(*this),
          .step = steps() ? &group->motion(place) : nullptr,
          .speedBound = bounds.speed,
          .accelerationBound = bounds.acceleration,
          .driven = isDriven() ? &drivenBy->motion : nullptr,
          .jerk = flight.jerk,
          .lasts = flight.jerk.isZero(0) ? 0 : elapsed(foreseen)};
}

bool areTouching(const BoxAt& a, const BoxAt& b, double apart) {
  const double within = std::max(apart, touchingWithin(a, b));
  const double reach = a.radius() + b.radius() + within;
  return (a.pose.position - b.pose.position).norm() <= reach && BoxAxes(a, b).gap() <= within;
}

bool areTouching(const Body& a, const Pose& poseA, const Body& b, const Pose& poseB, double apart) {
  return anyBoxes(a, poseA, b, poseB,
                  [&](const BoxAt& boxA, const BoxAt& boxB) { return areTouching(boxA, boxB, apart); });
}

}  // namespace careen
