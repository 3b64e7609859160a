#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/system/team.h"
#include "physics/contact/contact_feature.h"
#include "physics/exact/event_queue.h"
#include "physics/exact/mover.h"
#include "physics/impact/impact_law.h"
#include "physics/motion/recorder.h"
#include "physics/search/neighbors.h"
#include "physics/world/flight_account.h"
#include "physics/world/run_settings.h"
#include "physics/world/world.h"

namespace careen {

class ChangingWorld;

/// All bodies of method exact: how each moves now, and what happens to it next. A motion that begins is
/// recorded, and an event that is predicted is queued.
///
/// Bodies are identified by rank, their position in the order of names, so that their order in the scene
/// changes no bit; walls come after them.
class Bodies {
 public:
  /// `changing`, if there is one, is what changes the world. All must outlive it. Where joints end in the
  /// world there is one more after the walls, which is nowhere().
  Bodies(const World& world, const RunSettings& settings, Recorder& recorder,
         const ChangingWorld* changing = nullptr);

  const World& world() const { return world_; }
  const ChangingWorld* changing() const { return changing_; }
  const Instant& end() const { return end_; }  ///< of the run
  /// Until when flights are: the end of the run, or where gravity, if it slopes, does so otherwise.
  Instant foreseen() const;
  double tolerance() const { return tolerance_; }      ///< [m]
  double timeScale() const { return timeScale_; }      ///< [s] see timeScaleOf
  double longestStep() const { return longestStep_; }  ///< [s] of an island
  const CrowdSettings& crowds() const { return crowds_; }
  const std::shared_ptr<Team>& team() const { return team_; }  ///< of all crowds
  Recorder& recorder() { return recorder_; }
  FlightAccount& account() { return account_; }
  EventQueue& queue() { return queue_; }

  /// Of boxes; the walls are those after them.
  int count() const { return static_cast<int>(world_.bodies.size()); }
  std::span<const Mover> walls() const {
    return std::span(movers_).subspan(world_.bodies.size(), world_.walls.size());
  }
  Mover& operator[](int rank) { return movers_[static_cast<std::size_t>(rank)]; }
  const Mover& operator[](int rank) const { return movers_[static_cast<std::size_t>(rank)]; }
  /// Springs, joints or drag act on it, so it is never in Flight.
  bool isForced(int rank) const { return forced_[static_cast<std::size_t>(rank)] != 0; }
  /// Bodies attached to it by springs and joints.
  std::span<const int> joinedTo(int rank) const { return bonds_[static_cast<std::size_t>(rank)]; }
  /// All that it can touch in its cell or those around it, sorted.
  std::vector<int> around(int rank) const;
  /// Whether does(rank) is true of any of them.
  template <class Does>
  bool anyAround(int rank, const Does& does) const {
    return neighbors_.anyCandidate(rank, does);
  }

  /// All that may get into that box [m] within that time [s] from `time` on, not longer ago than that, and
  /// perhaps others; sorted.
  std::vector<int> mayReach(const Vec3& low, const Vec3& high, const Instant& time, double length) const;

  /// What a body does from then on.
  void fly(int rank, const Instant& time, const BodyState& state, const Quat& attitude);
  void rest(int rank, const Instant& time, const Pose& pose);
  /// It does not move between two moments, through all the hops that are too short to follow: none is as high
  /// as its rounding.
  void stand(int rank, const Instant& from, const Instant& until, const Vec3& position, const Quat& attitude);
  /// It rests, and stays a member of its group.
  void sleep(int rank, const Instant& time, const Pose& pose);
  /// It moves as its group does in the step that begins.
  void step(const std::shared_ptr<ContactGroup>& group, std::size_t place);
  /// An impact at that point [m] of a body with another one, both by rank.
  void strike(const Instant& time, int rank, int with, const Vec3& point, const ImpactShare& share);
  /// Its doubt from then on, none if it is held. Past its size its place means nothing.
  Doubt* doubtAt(int rank, const Instant& time);
  /// A flight ends in this state.
  void arrive(const Mover& body, const Instant& time, const BodyState& state);

  void predict(int rank);
  /// Of those around one that predicts nothing itself.
  void predictAround(int rank);
  /// It has entered the cell that it was to cross into.
  void cross(int rank);
  /// Gravity has changed, or what is driven begins another part of its course; all that can move will fly
  /// anew.
  void feelJump(const Instant& time);
  /// Others find it from now on where that position [m] is.
  void file(int rank, const Vec3& position);
  void findCrossing(int rank);
  /// [s] Time in which a body of this speed [m/s] does not leave the margin of its cell.
  double withinCell(double speed) const;

  /// Island::work() that bodies may spend together before they go on as a crowd: each of kFew in a scene so
  /// much at once, and so much per simulated second; at a tolerance below the usual one more, as steps get
  /// shorter. Fewer bodies share the same; of more each may spend less, as the square, and less still where
  /// more than a few moved at once: a heap costs more per body the larger it is. A unit takes about 0.2 to 1
  /// µs. Counted, not timed, so that the motion is the same on every machine, and independent of when the run
  /// ends.
  static constexpr double kWorkAtOnce = 6e5;
  static constexpr double kWorkPerSecond = 5e4;
  static constexpr int kFew = 16;
  /// What these may still spend; negative where they must go on as a crowd. In a scene of more than a few,
  /// those in contact of whom one is in such doubt as a crowd is anyway may spend nothing at once.
  double workLeft(std::span<const int> ranks, const Instant& time) const;

  /// Most events of one body at one moment before it goes on in a crowd, and of twice as many the run gives
  /// up: more than any impact needs, and a bound on endless repetition.
  static constexpr int kMostAtOneMoment = 1000;

 private:
  void begins(int rank, const Instant& time);
  void noteSpeed(const Mover& body);

  const World& world_;
  const ChangingWorld* changing_ = nullptr;
  Instant end_;
  double tolerance_;
  CrowdSettings crowds_;
  std::shared_ptr<Team> team_;
  double timeScale_;
  double longestStep_;
  double workShare_ = 0;  // [1] of the work per body above that each may spend
  bool isFew_ = true;     // bodies that can move
  Recorder& recorder_;
  std::vector<Mover> movers_;
  Neighbors neighbors_;
  EventQueue queue_;
  FlightAccount account_;
  // [m/s] No body that moves is faster at time t than this and t times gravity, in a scene of so many found
  // anew after so many motions; the most that moved then.
  double fastestAtZero_ = -std::numeric_limits<double>::infinity();
  int mostMoving_ = 0;
  int noted_ = 0;
  std::vector<char> forced_;             // by rank
  std::vector<std::vector<int>> bonds_;  // by rank
};

/// Of more than a few bodies in contact, time steps cost so much that it does not pay to begin.
bool isTooMany(const Bodies& bodies, int movable);
/// A body that takes part in an impact at that time, in this state after it.
DoubtfulBody doubtful(Bodies& bodies, int rank, const Instant& time, const BodyState& after);
/// [s] From that time on, until a joint lets go or its motor may change.
double untilChange(const Bodies& bodies, const Joint& joint, const Instant& time);
/// Whether joints end in the world.
bool endsInWorld(const World& world);

}  // namespace careen
