#pragma once

#include <cstddef>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "physics/event_queue.h"
#include "physics/flight_account.h"
#include "physics/impact_law.h"
#include "physics/method.h"
#include "physics/mover.h"
#include "physics/neighbors.h"
#include "physics/recorder.h"
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
  void addPairContacts(Group& group, std::size_t indexA, std::size_t indexB);
  void resolve(Group& group);
  void settle(Group& group) const;
  double lengthsAt(const Group& group, std::size_t k) const;
  void settleBody(Group& group, std::size_t index) const;
  void checkParts(const Group& group, const Event& event) const;
  void record(const Group& group);

  void fly(int rank, const Instant& time, const BodyState& state, const Quat& attitude);
  void rest(int rank, const Instant& time, const Pose& pose);
  void begins(int rank, const Instant& time);
  void arrive(const Mover& body, const Instant& time, const BodyState& state);

  void predict(int rank);
  static void sooner(std::optional<Event>& first, const Event& candidate);
  void findCrossing(Mover& body, int rank);

  Mover& mover(int rank) { return movers_[static_cast<std::size_t>(rank)]; }
  const Mover& mover(int rank) const { return movers_[static_cast<std::size_t>(rank)]; }
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
