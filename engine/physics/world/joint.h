#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "core/math/linear_algebra.h"
#include "core/math/pose.h"
#include "physics/world/body.h"

namespace careen {

/// End of a joint: a frame fixed in a body, or in the world.
struct JointEnd {
  std::optional<int> body;    ///< index in the world; nothing: the world itself
  Vec3 point = Vec3::Zero();  ///< [m] its origin, in the body's frame
  Mat3 axes =
      Mat3::Identity();  ///< [1] columns x, y, z in the body's frame; z is the axis of a hinge or slider

  /// [m] The origin, world; [1] its axes, world. `pose` is the body's, or anything for the world.
  Vec3 pointAt(const Pose& pose) const {
    return body ? Vec3(pose.position + pose.worldFromBody * point) : point;
  }
  Mat3 axesAt(const Pose& pose) const { return body ? Mat3(pose.worldFromBody * axes) : axes; }
};

/// What holds two bodies together, or a body and the world. Both ends' frames coincide where a joint's
/// coordinate is zero: the angle of a hinge [rad], the way of a slider [m], of `from` relative to `to`.
///
///   ball     one point in common
///   hinge    a point and an axis
///   slider   an axis; neither turns about it relative to the other
///   fixed    everything
///   rod      a distance between two points
///   rope     no more than a distance
struct Joint {
  enum class Kind : unsigned char { kBall, kHinge, kSlider, kFixed, kRod, kRope };
  static constexpr double kFree = std::numeric_limits<double>::infinity();

  std::string name;
  Kind kind{};
  JointEnd from;  ///< of a body
  JointEnd to;
  double length = 0;       ///< [m] of a rod or rope
  double lowest = -kFree;  ///< [rad] of a hinge, [m] of a slider: where its coordinate ends
  double highest = kFree;  ///< likewise; less than a turn of a hinge from the lowest
  double restitution = 0;  ///< [1] of its limits, or where a rope becomes taut
  double until = kFree;    ///< [s] when it lets go
  // Of a hinge or slider, along its coordinate q: the force [N] or torque [N m] on `from` is
  // effort − stiffness (q − rest) − damping q̇.
  double stiffness = 0;  ///< [N/m] or [N m/rad]
  double rest = 0;       ///< [m] or [rad]
  double damping = 0;    ///< [N s/m] or [N m s/rad]
  double effort = 0;     ///< [N] or [N m] of its motor, as a control sets it
  // It keeps to a speed as far as no more than its grip is needed; else the grip drives it there. Dry
  // friction keeps to none.
  double grip = 0;      ///< [N] or [N m]
  double keptRate = 0;  ///< [m/s] or [rad/s]

  /// Whether it has the coordinate that may be limited.
  bool hasCoordinate() const { return kind == Kind::kHinge || kind == Kind::kSlider; }
  bool isLoaded() const { return stiffness != 0 || damping != 0 || effort != 0 || grip != 0; }
  /// [N] or [N m] By which it gives energy, or takes it: a grip gives at most as much, and what it gives less
  /// is lost.
  double drive() const { return effort + (keptRate == 0 ? 0 : keptRate > 0 ? grip : -grip); }
};

/// As scene files spell them, in the order of Joint::Kind.
inline constexpr std::array<std::string_view, 6> kJointKindNames = {"ball",  "hinge", "slider",
                                                                    "fixed", "rod",   "rope"};

/// [rad] of a hinge, in (−π, π] from the middle of its limits, or from where its spring rests; [m] of a
/// slider. Poses of both bodies.
double jointCoordinate(const Joint& joint, const Pose& from, const Pose& to);

/// A coordinate in that turn of a hinge in which it is the nearest to another one; of a slider as it is.
double inNearestTurn(const Joint& joint, double coordinate, double other);

}  // namespace careen
