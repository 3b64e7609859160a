#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "physics/attitude/torque_free_rotation.h"
#include "physics/exact/contact_group.h"
#include "physics/exact/doubt.h"
#include "physics/exact/event_queue.h"
#include "physics/motion/flight.h"
#include "physics/motion/recorder.h"
#include "physics/search/neighbors.h"
#include "physics/search/time_of_impact.h"
#include "physics/world/body.h"

namespace careen {

/// One body of method exact, a box or a wall: its current motion and its predicted events.
struct Mover {
  /// kSteps: with a group of bodies in contact. kDriven: held, and moves by itself.
  enum class Kind { kRests, kFlies, kSteps, kDriven };

  const Body* body = nullptr;
  const Wall* halfSpace = nullptr;  ///< its shape; null: the body's box
  int rank = 0;      ///< its position in the order of names, which identifies it; walls come last
  BodyIndex listed;  ///< its index in the scene
  Kind kind = Kind::kRests;
  Flight flight;                                    ///< if it flies
  const CoursePart* drivenBy = nullptr;             ///< if it is driven
  std::shared_ptr<ContactGroup> group;              ///< of which it is a member, perhaps asleep
  std::size_t place = 0;                            ///< its index in that group
  double work = 0;                                  ///< its share of Island::work() so far
  Doubt doubt;                                      ///< none if it is held
  std::optional<PrincipalMoments<double>> moments;  ///< if it was ever in Flight
  std::optional<TorqueFreeRotation<double>> rotation;
  StepBounds bounds;  ///< of its motion; in Flight only of its turning
  Pose pose;          ///< if it rests or is immovable
  Instant start{};
  std::uint64_t motion = 0;      ///< counts its motions: predictions for an earlier one are stale
  int atOneMoment = 0;           ///< how many of them began at `start`
  Instant windowStart{};         ///< see settle()
  int changesInWindow = 0;       ///< motions begun since
  int timeSteps = 0;             ///< taken since it chattered
  Instant chatteredFrom{};       ///< when they began
  std::optional<Event> wall;     ///< the flight's first contact with a wall
  bool crosses = false;          ///< it can enter other cells
  Neighbors::Crossing crossing;  ///< the next such event

  bool isHeld() const { return body->mass.inverseMass == 0; }
  const Course& course() const { return isBox() ? body->course : halfSpace->course; }
  bool isBox() const { return halfSpace == nullptr; }
  bool flies() const { return kind == Kind::kFlies; }
  bool steps() const { return kind == Kind::kSteps; }
  bool isDriven() const { return kind == Kind::kDriven; }
  bool moves() const { return kind != Kind::kRests; }
  /// `attitude` is that of `state`, but may not reproduce its matrix to the bit.
  void fly(const BodyState& state, const Quat& attitude, const Vec3& gravity, const Vec3& jerk);
  /// What is held does so.
  void drive(const CoursePart& by);
  /// It stays a member of its group.
  void rest(const Pose& at);
  /// As the group moves it in its current step.
  void step(std::shared_ptr<ContactGroup> with, std::size_t as);

  double elapsed(const Instant& time) const { return secondsBetween(start, time); }
  Vec3 positionAt(const Instant& time) const;
  Quat attitudeAt(const Instant& time) const;
  BodyState stateAt(const Instant& time, const Quat& attitude) const;
  BodyState stateAt(const Instant& time) const { return stateAt(time, attitudeAt(time)); }
  /// For the contact search; `elapsed` [s] counts from the start of the motion.
  Attitude operator()(double elapsed) const;
  /// One of its boxes, with time 0 of the search at `clockZero`; a flight lasts as long as is `foreseen`.
  MovingBox moving(const Instant& clockZero, int box, const Instant& foreseen) const;
};

/// Whether the gap of two boxes is within the contact-group tolerance, or within `apart` [m] if that is more.
bool areTouching(const BoxAt& a, const BoxAt& b, double apart = 0);
/// Whether that of any two boxes of two bodies is.
bool areTouching(const Body& a, const Pose& poseA, const Body& b, const Pose& poseB, double apart = 0);

}  // namespace careen
