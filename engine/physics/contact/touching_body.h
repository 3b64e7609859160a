#pragma once

#include <cstddef>
#include <span>

#include "physics/contact/contact_feature.h"
#include "physics/world/world.h"

namespace careen {

/// A body of an island of touching bodies: a box or a half-space.
struct TouchingBody {
  const Body* body = nullptr;
  const Wall* halfSpace = nullptr;  ///< its shape; null: the body's box
  int index = 0;                    ///< of the body in the world
  Vec3 position = Vec3::Zero();
  Quat worldFromBody = Quat::Identity();
  Vec3 velocity = Vec3::Zero();             ///< [m/s]
  Vec3 angularVelocityBody = Vec3::Zero();  ///< [rad/s] body frame
  const CoursePart* drivenBy = nullptr;     ///< if it is driven: by that
  double time = 0;                          ///< [s] when it is there

  bool isDriven() const { return drivenBy != nullptr; }
  bool isHeld() const { return isImmovable(body->mass); }
  bool isBox() const { return halfSpace == nullptr; }
  bool isNowhere() const { return halfSpace == &nowhere(); }
  /// Of a half-space that, else one of its boxes.
  TouchingShape shape(int box) const {
    return isBox() ? shapeOf(*body, box)
                   : TouchingShape{
                         .halfExtents = body->halfExtents, .center = body->boxCenter, .halfSpace = halfSpace};
  }
  /// Of a half-space, where it is.
  WallPlane plane() const { return planeOf(*halfSpace, kinematics().pose); }
  const Material& material() const { return isBox() ? body->material : halfSpace->material; }
  BodyState state() const {
    const Mat3 columns = worldFromBody.toRotationMatrix();
    return {.pose = {.position = position, .worldFromBody = columns},
            .velocity = velocity,
            .angularMomentum =
                columns * (isHeld() ? angularVelocityBody : body->mass.inertiaTimes(angularVelocityBody))};
  }
  Kinematics kinematics() const {
    if (isDriven()) {
      return drivenBy->at(time);
    }
    const Mat3 columns = worldFromBody.toRotationMatrix();
    return {
        .pose = {position, columns}, .velocity = velocity, .angularVelocity = columns * angularVelocityBody};
  }
};
/// Something driven, at that time [s].
TouchingBody drivenAt(const TouchingBody& body, double time);
/// [m/s²] The largest acceleration at which any of them is driven, corners included.
double drivenAcceleration(std::span<const TouchingBody> bodies);
inline TouchingBody touchingBody(const Wall& wall) { return {.body = &bodyOfWalls(), .halfSpace = &wall}; }

/// How many of a group are boxes: half-spaces come after them.
inline std::size_t boxesOf(std::span<const TouchingBody> bodies) {
  std::size_t boxes = bodies.size();
  while (boxes > 0 && !bodies[boxes - 1].isBox()) {
    --boxes;
  }
  return boxes;
}

}  // namespace careen
