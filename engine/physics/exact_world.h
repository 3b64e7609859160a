#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "physics/event_queue.h"
#include "physics/flight.h"
#include "physics/flight_account.h"
#include "physics/impact_law.h"
#include "physics/method.h"
#include "physics/neighbors.h"
#include "physics/recorder.h"
#include "physics/time_of_impact.h"
#include "physics/torque_free_rotation.h"
#include "physics/world.h"

namespace careen {

/// Method `exact`. Every body flies in closed form from impact to impact, or rests; between events nothing is
/// computed, and an event touches only the bodies that take part in it. Where a body would have to slide,
/// rock or be stacked for a while it ends in a NumericalError that says so.
///
/// Bodies go by rank, their place among the names, so that the order in which a scene lists them changes no
/// bit.
class ExactWorld {
 public:
  ExactWorld(const World& world, double duration, Recorder& recorder);
  RunFigures run(const std::stop_token& stop);

 private:
  struct Mover {
    const Body* body = nullptr;
    BodyIndex listed;  ///< its place in the scene
    bool flies = false;
    Flight flight;  ///< if it flies
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
    Attitude operator()(double elapsed) const;
  };
  /// Bodies that touch at one moment, and what becomes of them.
  struct Group {
    Instant time;
    std::vector<int> ranks;  ///< sorted
    std::vector<Quat> attitudes;
    std::vector<BodyState> before;
    std::vector<BodyState> after;
    std::vector<ImpactContact> contacts;  ///< their bodies are indices into `ranks`
    std::vector<int> partners;            ///< of each contact, as in Event
    std::vector<ImpactShare> shares;
    std::vector<std::optional<Instant>> restsFrom;  ///< of each body
  };

  void begin();
  void happen(const Event& event);
  void moveOn(const Group& group);
  void end();

  Group gather(const Event& event);
  std::vector<int> touchingFrom(const Event& event) const;
  static bool touch(const Mover& a, const Mover& b, const Instant& time);
  void addWallContacts(Group& group, std::size_t index);
  void addPairContacts(Group& group, std::size_t indexA, std::size_t indexB);
  void resolve(Group& group);
  void settle(Group& group) const;
  void settleBody(Group& group, std::size_t index) const;
  void checkParts(const Group& group, const Event& event) const;
  void record(const Group& group);

  void fly(int rank, const Instant& time, const BodyState& state, const Quat& attitude);
  void rest(int rank, const Instant& time, const Pose& pose);
  void begins(int rank, const Instant& time);
  void arrive(const Mover& body, const Instant& time);

  void predict(int rank);
  static void sooner(std::optional<Event>& first, const Event& candidate);
  std::optional<Event> firstWall(int rank) const;
  static bool moveAsOne(const Mover& a, const Mover& b);
  std::optional<Event> firstMeeting(int rank, int partner, const Instant& until) const;
  void findCrossing(Mover& body, int rank);

  Mover& mover(int rank) { return movers_[static_cast<std::size_t>(rank)]; }
  const Mover& mover(int rank) const { return movers_[static_cast<std::size_t>(rank)]; }
  static double elapsed(const Mover& body, const Instant& time) { return secondsBetween(body.start, time); }
  static Quat attitudeAt(const Mover& body, const Instant& time);
  static BodyState stateAt(const Mover& body, const Instant& time, const Quat& attitude);
  static MovingBox moving(const Mover& body, const Instant& clockZero);
  std::string where(int rank, const Instant& time) const;

  const World& world_;
  Instant end_;
  Recorder& recorder_;
  std::vector<Mover> movers_;
  Neighbors neighbors_;
  EventQueue queue_;
  FlightAccount account_;
  std::vector<Neighbors::Key> candidates_;
};

}  // namespace careen
