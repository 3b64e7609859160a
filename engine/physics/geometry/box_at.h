#pragma once

#include <array>

#include "core/math/linear_algebra.h"
#include "core/math/pose.h"
#include "physics/world/body.h"

namespace careen {

/// A box at a place, as an argument: a view of its body's pose and its size, not to be stored.
struct BoxAt {
  const Pose& pose;                ///< of the body: its origin is the centre of mass
  const Vec3& halfExtents;         ///< [m] half sizes along the box's axes
  const Vec3& center = kCentered;  ///< [m] middle of the box, body frame

  static inline const Vec3 kCentered = Vec3::Zero();

  bool isCentered() const { return center.x() == 0 && center.y() == 0 && center.z() == 0; }
  /// [m] World: from the body's origin to the middle of the box, and the middle's place.
  Vec3 arm() const { return isCentered() ? kCentered : Vec3(pose.worldFromBody * center); }
  Vec3 middle() const { return isCentered() ? pose.position : pose.worldPoint(center); }
  /// [m] From the body's origin to the furthest corner.
  double radius() const { return (center.cwiseAbs() + halfExtents).norm(); }
};

/// The box of a body. Both must outlive it.
inline BoxAt boxAt(const Pose& pose, const Body& body) {
  return {.pose = pose, .halfExtents = body.halfExtents, .center = body.boxCenter};
}

/// Which of two boxes plays the part of a where both may: whichever is smaller, else nearer to the origin. It
/// does not follow from their names, nor change in mirrors and units; boxes that are equal in both stay as
/// they are listed.
inline bool comesFirst(BoxAt x, BoxAt y) {
  const std::array<double, 2> ofX{x.halfExtents.squaredNorm(), x.pose.position.squaredNorm()};
  const std::array<double, 2> ofY{y.halfExtents.squaredNorm(), y.pose.position.squaredNorm()};
  return ofX < ofY;
}

}  // namespace careen
