#pragma once

#include <array>

#include "core/math/linear_algebra.h"
#include "core/math/pose.h"
#include "physics/world/body.h"

namespace careen {

/// A box of a body at a place.
struct BoxAt {
  Pose pose;                   ///< of the box's own frame: its origin is the body's centre of mass
  Vec3 halfExtents;            ///< [m] half sizes along the box's axes
  Vec3 center = Vec3::Zero();  ///< [m] middle of the box, own frame
  int part = 0;                ///< which of its body's boxes

  bool isCentered() const { return center.x() == 0 && center.y() == 0 && center.z() == 0; }
  /// [m] World: from the body's origin to the middle of the box, and the middle's place.
  Vec3 arm() const { return isCentered() ? Vec3(Vec3::Zero()) : Vec3(pose.worldFromBody * center); }
  Vec3 middle() const { return isCentered() ? pose.position : pose.worldPoint(center); }
  /// [m] From the body's origin to the furthest corner.
  double radius() const { return (center.cwiseAbs() + halfExtents).norm(); }
};

/// The box of a body, or that around all of its boxes.
inline BoxAt boxAt(const Pose& pose, const Body& body) {
  return {.pose = pose, .halfExtents = body.halfExtents, .center = body.boxCenter};
}
/// One box of a body, given the body's pose.
inline BoxAt boxAt(const Pose& pose, const BodyPart& part, int index) {
  return {.pose = {pose.position, part.ownAxes(pose.worldFromBody)},
          .halfExtents = part.halfExtents,
          .center = part.center,
          .part = index};
}
inline BoxAt boxAt(const Pose& pose, const Body& body, int index) {
  return body.parts.empty() ? boxAt(pose, body) : boxAt(pose, body.part(index), index);
}

/// Calls visit(boxA, boxB) for all boxes of a body with all of another, given their poses.
template <class Visit>
void forBoxes(const Body& a, const Pose& poseA, const Body& b, const Pose& poseB, const Visit& visit) {
  for (int i = 0; i < a.partCount(); ++i) {
    const BoxAt boxA = boxAt(poseA, a, i);
    for (int j = 0; j < b.partCount(); ++j) {
      visit(boxA, boxAt(poseB, b, j));
    }
  }
}

/// Which of two boxes plays the part of a where both may: whichever is smaller, else nearer to the origin. It
/// does not follow from their names, nor change in mirrors and units; boxes that are equal in both stay as
/// they are listed.
inline bool comesFirst(const BoxAt& x, const BoxAt& y) {
  const std::array<double, 2> ofX{x.halfExtents.squaredNorm(), x.pose.position.squaredNorm()};
  const std::array<double, 2> ofY{y.halfExtents.squaredNorm(), y.pose.position.squaredNorm()};
  return ofX < ofY;
}

}  // namespace careen
