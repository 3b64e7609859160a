#pragma once

#include <cstdint>
#include <optional>

#include "physics/body.h"
#include "physics/event_queue.h"
#include "physics/flight.h"
#include "physics/neighbors.h"
#include "physics/recorder.h"
#include "physics/time_of_impact.h"
#include "physics/torque_free_rotation.h"

namespace careen {

/// One body of method exact: what it does now, and what was predicted of it.
struct Mover {
  const Body* body = nullptr;
  BodyIndex listed;  ///< its place in the scene
  bool flies = false;
  Flight flight;                                    ///< if it flies
  std::optional<PrincipalMoments<double>> moments;  ///< if it ever flew
  std::optional<TorqueFreeRotation<double>> rotation;
  double angularSpeedBound = 0;         ///< [rad/s]
  double angularAccelerationBound = 0;  ///< [rad/s²]
  Pose pose;                            ///< if it rests, or is held
  Instant start{};
  std::uint64_t motion = 0;      ///< counts flights and rests: what was predicted for another is stale
  int atOneMoment = 0;           ///< how many of them began at `start`
  std::optional<Event> wall;     ///< the flight's first contact with a wall
  bool crosses = false;          ///< it enters other cells
  Neighbors::Crossing crossing;  ///< the next one

  bool isHeld() const { return body->mass.inverseMass == 0; }
  /// `attitude` is that of `state`, whose matrix it may not make to the bit.
  void fly(const BodyState& state, const Quat& attitude, const Vec3& gravity);
  void rest(const Pose& at);

  double elapsed(const Instant& time) const { return secondsBetween(start, time); }
  Quat attitudeAt(const Instant& time) const;
  BodyState stateAt(const Instant& time, const Quat& attitude) const;
  BodyState stateAt(const Instant& time) const { return stateAt(time, attitudeAt(time)); }
  /// As the search for contacts sees it; `elapsed` [s] counts from the motion's start.
  Attitude operator()(double elapsed) const;
  /// With the clock of the search at 0 at that moment.
  MovingBox moving(const Instant& clockZero) const;
};

/// Whether the gap of two boxes is within the grouping tolerance at a moment.
bool touch(const Mover& a, const Mover& b, const Instant& time);

}  // namespace careen
