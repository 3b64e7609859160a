#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "physics/attitude/torque_free_rotation.h"
#include "physics/contact/island.h"
#include "physics/exact/event_queue.h"
#include "physics/motion/flight.h"
#include "physics/motion/recorder.h"
#include "physics/search/neighbors.h"
#include "physics/search/time_of_impact.h"
#include "physics/world/body.h"

namespace careen {

/// An island in the world: which body is which, and the step it is in.
struct ContactGroup {
  Island island;
  std::vector<int> ranks;            ///< of island.bodies()
  std::vector<ContactStep> motions;  ///< of those that can move, in this step
  Instant start{};                   ///< of this step
  Island::Step step{};

  /// The body that has the step's end as an event.
  int leader() const;
  Instant end() const { return instantAfter(start, step.length); }
};

/// One body of method exact: what it does now, and what was predicted of it.
struct Mover {
  const Body* body = nullptr;
  BodyIndex listed;  ///< its place in the scene
  bool flies = false;
  Flight flight;                                    ///< if it flies
  std::shared_ptr<ContactGroup> contactGroup;       ///< if it is in Contact: with whom
  std::size_t place = 0;                            ///< among them
  std::optional<PrincipalMoments<double>> moments;  ///< if it ever flew
  std::optional<TorqueFreeRotation<double>> rotation;
  double speedBound = 0;                ///< [m/s] if it is in Contact
  double accelerationBound = 0;         ///< [m/s²] likewise
  double angularSpeedBound = 0;         ///< [rad/s]
  double angularAccelerationBound = 0;  ///< [rad/s²]
  Pose pose;                            ///< if it rests, or is held
  Instant start{};
  std::uint64_t motion = 0;      ///< counts flights and rests: what was predicted for another is stale
  int atOneMoment = 0;           ///< how many of them began at `start`
  Instant windowStart{};         ///< see ExactWorld::findChattering
  int changesInWindow = 0;       ///< motions begun since
  Instant chatteringUntil{};     ///< it moves by time steps so long
  int timeSteps = 0;             ///< how many of them that was
  std::optional<Event> wall;     ///< the flight's first contact with a wall
  bool crosses = false;          ///< it enters other cells
  Neighbors::Crossing crossing;  ///< the next one

  bool isHeld() const { return body->mass.inverseMass == 0; }
  bool touches() const { return contactGroup != nullptr; }
  bool moves() const { return flies || touches(); }
  /// `attitude` is that of `state`, whose matrix it may not make to the bit.
  void fly(const BodyState& state, const Quat& attitude, const Vec3& gravity);
  void rest(const Pose& at);
  void touch(std::shared_ptr<ContactGroup> with, std::size_t as);

  double elapsed(const Instant& time) const { return secondsBetween(start, time); }
  Vec3 positionAt(const Instant& time) const;
  Quat attitudeAt(const Instant& time) const;
  BodyState stateAt(const Instant& time, const Quat& attitude) const;
  BodyState stateAt(const Instant& time) const { return stateAt(time, attitudeAt(time)); }
  /// As the search for contacts sees it; `elapsed` [s] counts from the motion's start.
  Attitude operator()(double elapsed) const;
  /// With the clock of the search at 0 at that moment.
  MovingBox moving(const Instant& clockZero) const;
};

/// Whether the gap of two boxes is within the grouping tolerance, or within `apart` [m] if that is more.
bool areTouching(const Body& a, const Pose& poseA, const Body& b, const Pose& poseB, double apart = 0);

}  // namespace careen
