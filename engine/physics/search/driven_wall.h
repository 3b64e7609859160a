#pragma once

#include "physics/search/time_of_impact.h"

namespace careen {

/// A wall that is driven, for the search of time_of_impact.h: the plane through the origin of its frame.
struct DrivenWall {
  Vec3 normal = Vec3::UnitZ();  ///< [1] unit, in that frame
  const Driven& driven;
  double age = 0;  ///< [s] time since its motion began, at search time 0

  /// Whether it goes straight on at one speed: what it meets is then as seen from it.
  bool isUniform() const { return driven.spin.isZero(0) && !driven.swings(); }
  /// Where it is at a search time [s], as normal·x = offset.
  Vec3 normalAt(double time) const { return driven.at(age + time).pose.worldFromBody * normal; }
  double offsetAt(double time) const { return dot(normalAt(time), driven.at(age + time).pose.position); }
};

/// The same box as seen from a wall that is uniform, which is where it is at search time 0. The box's age
/// must be 0.
MovingBox seenFrom(const DrivenWall& wall, const MovingBox& box);

/// As firstContactWithWall of a still one, but for the corners, which are not told. The gap of a corner is
/// n·(Δ + r), where n turns with the wall and Δ leads from the wall's origin to the centre of mass: the bound
/// M of its second derivative is that of a face of b.
FirstContact firstContactWithWall(const MovingBox& box, const DrivenWall& wall, const SearchWindow& window);

}  // namespace careen
