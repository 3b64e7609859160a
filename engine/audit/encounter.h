#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/world/world.h"

namespace careen {

/// A body between two rows of a table, and one thing that it may have touched meanwhile: the only one, but
/// for what touched nothing else and whose impulse is known.
struct ObservedEncounter {
  const Body* body = nullptr;
  BodyState before = {};
  BodyState after = {};
  const Wall* wall = nullptr;   ///< this,
  const Body* other = nullptr;  ///< or a box
  BodyState otherBefore = {};
  BodyState otherAfter = {};
  Vec3 gravity = Vec3::Zero();
  Vec3 passed = Vec3::Zero();  ///< [N s] that the body passed on to others
  double seconds = 0;          ///< from row to row
  double near = 0;             ///< [m] what is no farther apart may push each other
  double part = 0;             ///< [1] speeds may be off by this part of the largest
  double doubt = 0;            ///< [m/s] and by this, if they were estimated
};

/// Where both may push each other.
struct Touch {
  struct Point {
    Vec3 place = Vec3::Zero();
    double gap = 0;  ///< [m]
  };
  Vec3 normal = Vec3::Zero();  ///< towards the body
  std::vector<Point> points;  ///< corners of the one that has fewer near: forces act between those that touch
  double gap = 0;             ///< [m] of the nearest
};

/// [m] How far apart they are.
double gapOf(const ObservedEncounter& encounter, const BodyState& body, const BodyState& other);

/// None where several directions separate two boxes equally well.
std::optional<Touch> touchOf(const ObservedEncounter& encounter, const BodyState& body,
                             const BodyState& other);

/// [m/s] Velocity of the body's point relative to the other's.
Vec3 approachAt(const ObservedEncounter& encounter, const BodyState& body, const BodyState& other,
                const Vec3& place);

/// [N s] What the body was given that gravity does not explain.
Vec3 impulseOf(const ObservedEncounter& encounter);

/// [m] How close a body must have come to one of several things that cannot move, if they gave it an impulse:
/// it flies from its first row until it first touches one, and since it last did it flies to its second row.
double leastDistance(std::span<const ObservedEncounter> encounters);

/// [1] How far the scene's restitution is outside the interval that the rows leave it; 0: within, or nothing
/// can be said.
///
/// Until both touch first, each flies from its first row: that gives the moment, the points and their speed
/// of approach u. If both then fly to their second rows, with no other impact, that gives the speeds with
/// which the points part. Impulses pᵢ ≥ 0 of one impact fulfil Σ pᵢ (uᵢ' + e uᵢ) = 0, so that e is between
/// the least and the largest quotient. Whatever follows the first impact, it gave at least (1 + e) u / K,
/// where K [1/kg] is the largest inverse mass of a point, and took at least ½ (1 − e²) u² / K.
double restitutionBeyond(const ObservedEncounter& encounter);

/// [N s] What is wrong with friction; negative: nothing.
struct Friction {
  /// So much less than friction must the tangential impulse opposed the slip. Where all points that may touch
  /// slip in directions within an angle φ of d, the impulse along −d is at least μ cos φ times that along the
  /// normal. Nothing is known where slip may have stopped or turned between the rows.
  std::optional<double> missing;
  double surplus = 0;  ///< beyond the cone of friction
};
std::optional<Friction> frictionOf(const ObservedEncounter& encounter);

}  // namespace careen
