#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "physics/attitude/torque_free_rotation.h"
#include "physics/contact/island.h"
#include "physics/exact/event_queue.h"
#include "physics/motion/flight.h"
#include "physics/motion/joined_steps.h"
#include "physics/motion/recorder.h"
#include "physics/pile/crowd.h"
#include "physics/search/neighbors.h"
#include "physics/search/time_of_impact.h"
#include "physics/world/body.h"

namespace careen {

/// Bodies that advance together, and their current step: an island, exact, or a crowd, fast and of bounded
/// error.
struct ContactGroup {
  std::unique_ptr<Island> island;  ///< this or the other
  std::unique_ptr<Crowd> crowd;
  std::vector<int> ranks;            ///< of island->bodies(), or by the crowd's places: -1 where left
  std::vector<ContactStep> motions;  ///< of the movable ones, in this step
  Instant start{};                   ///< of this step
  Island::Step step{};
  int leader = 0;                   ///< rank of the body whose event is the end of the step
  double before = 0;                ///< [s] length of the crowd's step before this one, 0: none
  std::vector<JoinedSteps> joined;  ///< of a crowd, by place: not yet recorded

  Instant end() const { return instantAfter(start, step.length); }
};

/// One body of method exact: its current motion and its predicted events.
struct Mover {
  const Body* body = nullptr;
  BodyIndex listed;  ///< its index in the scene
  bool flies = false;
  Flight flight;                                    ///< if it flies
  std::shared_ptr<ContactGroup> contactGroup;       ///< if it is in Contact
  std::size_t place = 0;                            ///< its index in that group, or in the crowd
  std::shared_ptr<ContactGroup> crowd;              ///< of which it is a member, perhaps asleep
  double work = 0;                                  ///< its share of Island::work() so far
  std::optional<PrincipalMoments<double>> moments;  ///< if it was ever in Flight
  std::optional<TorqueFreeRotation<double>> rotation;
  double speedBound = 0;                ///< [m/s] if it is in Contact
  double accelerationBound = 0;         ///< [m/s²] likewise
  double angularSpeedBound = 0;         ///< [rad/s]
  double angularAccelerationBound = 0;  ///< [rad/s²]
  Pose pose;                            ///< if it rests or is immovable
  Instant start{};
  std::uint64_t motion = 0;      ///< counts its motions: predictions for an earlier one are stale
  int atOneMoment = 0;           ///< how many of them began at `start`
  Instant windowStart{};         ///< see ExactWorld::findChattering
  int changesInWindow = 0;       ///< motions begun since
  int timeSteps = 0;             ///< taken since it chattered
  Instant chatteredFrom{};       ///< when they began
  std::optional<Event> wall;     ///< the flight's first contact with a wall
  bool crosses = false;          ///< it can enter other cells
  Neighbors::Crossing crossing;  ///< the next such event

  bool isHeld() const { return body->mass.inverseMass == 0; }
  bool touches() const { return contactGroup != nullptr; }
  bool moves() const { return flies || touches(); }
  /// `attitude` is that of `state`, but may not reproduce its matrix to the bit.
  void fly(const BodyState& state, const Quat& attitude, const Vec3& gravity);
  void rest(const Pose& at);
  void touch(std::shared_ptr<ContactGroup> with, std::size_t as);

  double elapsed(const Instant& time) const { return secondsBetween(start, time); }
  Vec3 positionAt(const Instant& time) const;
  Quat attitudeAt(const Instant& time) const;
  BodyState stateAt(const Instant& time, const Quat& attitude) const;
  BodyState stateAt(const Instant& time) const { return stateAt(time, attitudeAt(time)); }
  /// For the contact search; `elapsed` [s] counts from the start of the motion.
  Attitude operator()(double elapsed) const;
  /// The same, with time 0 of the search at `clockZero`.
  MovingBox moving(const Instant& clockZero) const;
};

/// Whether the gap of two boxes is within the contact-group tolerance, or within `apart` [m] if that is more.
bool areTouching(BoxAt a, BoxAt b, double apart = 0);

}  // namespace careen
