#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "physics/exact/event_queue.h"
#include "physics/exact/mover.h"
#include "physics/impact/impact_law.h"
#include "physics/motion/recorder.h"
#include "physics/search/neighbors.h"
#include "physics/world/flight_account.h"
#include "physics/world/run_settings.h"
#include "physics/world/world.h"

namespace careen {

/// Method `exact`. Every body is in one of three motions: Flight in closed form from impact to impact,
/// Contact in steps chosen by the tolerance, or Rest. Between events nothing is computed, and an event
/// affects only the bodies involved in it.
///
/// Bodies in contact are an Island, exact to the tolerance. Where that costs too much, or its equations are
/// not solved, they go on as a Crowd, which takes in what it meets and releases what nothing touches; the
/// others do not notice. RunFigures reports it.
///
/// Bodies are identified by rank, their position in the order of names, so that their order in the scene
/// changes no bit.
class ExactWorld {
 public:
  ExactWorld(const World& world, const RunSettings& settings, Recorder& recorder);
  RunFigures run(const std::stop_token& stop);

  /// Island::work() that bodies may spend together before they go on as a crowd: each of kUnshared in a scene
  /// so much at once, and so much per simulated second; at a tolerance below 1e-6 m more, as steps get
  /// shorter. Fewer bodies share the same; of more each may spend less, as the square: a heap costs more per
  /// body the larger it is, so that 72 poured boxes would spend 36 s on their first 2 s, and chaos makes what
  /// is exact of a heap worth no more. A unit takes about 0.2 to 1 µs. Counted, not timed, so that the motion
  /// is the same on every machine, and independent of when the run ends.
  static constexpr double kWorkAtOnce = 6e5;
  static constexpr double kWorkPerSecond = 5e4;
  static constexpr double kUnshared = 16;
  /// Of more bodies in contact, time steps cost so much that it does not pay to begin.
  static constexpr int kMostInContact = 100;

 private:
  /// Most events of one body at one moment before it goes on in a crowd, and of twice as many the run gives
  /// up: more than any impact needs, and a bound on endless repetition.
  static constexpr int kMostAtOneMoment = 1000;
  /// [1] of timeScaleOf: changes of contact within it are counted together.
  static constexpr double kChatterWindow = 8;
  /// [1] of the tolerance: bodies that go on by time steps are one group up to this gap.
  static constexpr double kNear = 64;

  /// [1] roundings: contacts that meet again and again, and part no faster, pass each other.
  static constexpr double kHardlyParts = 0x1p20;

  /// What a body does after an event.
  enum class Next { kGoesOn, kFlies, kRests, kTouches };

  /// Bodies that touch at one moment, and their next motions.
  struct Encounter {
    Instant time;
    EventKind cause{};
    std::vector<int> ranks;  ///< sorted
    std::vector<Quat> attitudes;
    std::vector<BodyState> before;
    std::vector<BodyState> after;
    std::vector<ImpactContact> contacts;  ///< their bodies are indices into `ranks`
    std::vector<ImpactShare> shares;
    std::vector<char> persists;  ///< of each contact: it stays closed
    std::vector<Next> next;      ///< of each body
    std::vector<Instant> since;  ///< of each body: when that begins
    std::vector<std::shared_ptr<ContactGroup>> islands;
    std::vector<std::shared_ptr<ContactGroup>> crowds;  ///< that these bodies meet
    ContactResiduals residuals;                         ///< of the islands' first forces
    bool isTooMany = false;                             ///< an island of them
    int timeSteps = 0;                                  ///< its islands go on by so many
    double pull = 0;                                    ///< [m/s²] see pulls()
    double passing = 0;  ///< [1] contacts without an impulse persist that part with so many roundings
  };

  void begin();
  void happen(const Event& event);
  void moveOn(Encounter& encounter);
  void end();

  // Crowds.
  bool goesOnAsCrowd(const Encounter& encounter) const;
  bool isTooMany(int movable) const;
  double workLeft(std::span<const int> ranks, const Instant& time) const;
  void formCrowd(const Encounter& encounter);
  void enlist(const std::shared_ptr<ContactGroup>& crowd, int rank, const Instant& time,
              const BodyState& state, const Quat& attitude);
  void enlistAtRest(const std::shared_ptr<ContactGroup>& crowd, int rank);
  void keepPlace(const std::shared_ptr<ContactGroup>& crowd, int rank, std::size_t place);
  /// Of a member, to be recorded.
  JoinedSteps newPath() const;
  static double pastOf(const ContactGroup& crowd, const Mover& body, const Instant& time);
  JoinedSteps comingFrom(const Mover& body, const Instant& time, const BodyState& state, const Quat& attitude,
                         double length) const;
  void merge(const std::shared_ptr<ContactGroup>& crowd, ContactGroup& other);
  void advanceCrowd(const std::shared_ptr<ContactGroup>& crowd, const Instant& time);
  void joinStep(const std::shared_ptr<ContactGroup>& crowd, const Encounter& encounter);
  void endAt(const std::shared_ptr<ContactGroup>& crowd, const Instant& time);
  bool restsSince(int rank, const Instant& time) const;
  bool fliesSince(int rank, const Instant& time) const;
  void commit(ContactGroup& crowd, const Instant& time);
  std::vector<int> release(ContactGroup& crowd, const Instant& time);
  void go(const std::shared_ptr<ContactGroup>& crowd, const Instant& time);
  static std::vector<char> changedSuddenly(const ContactGroup& group);
  void endStep(ContactGroup& crowd, std::size_t place, std::span<const char> suddenly);
  std::vector<int> outsidersIn(const Crowd::Extent& extent, const ContactGroup& crowd, const Instant& time,
                               double length, bool past) const;
  void admitNear(const std::shared_ptr<ContactGroup>& crowd, const Instant& time, double length);
  void admitOutsider(const std::shared_ptr<ContactGroup>& crowd, int rank, const Instant& time);
  bool admitMet(const std::shared_ptr<ContactGroup>& crowd, const Instant& time, bool again);
  bool wasMet(const ContactGroup& crowd, int rank, const Instant& time);
  bool meetsNext(const ContactGroup& crowd, int rank, const Instant& time, double length);
  std::vector<int> nearStep(const ContactGroup& crowd);
  bool meetsWithin(const ContactGroup& crowd, int rank, const Mover& member, const Instant& time,
                   double length) const;

  // Detection of contacts, and impacts.
  Encounter gather(const Event& event);
  void findContacts(const Event& event, Encounter& encounter);
  void reach(const Event& event, Encounter& encounter);
  void join(Encounter& encounter, int rank);
  double nearness(const Encounter& encounter) const;
  double pullOf(const Encounter& encounter) const;
  std::vector<BodyState> statesIn(const Encounter& encounter, const std::vector<BodyState>& of) const;
  void addPairContacts(Encounter& encounter, std::size_t indexA, std::size_t indexB) const;
  bool inSteps(const Encounter& encounter, std::size_t indexA, std::size_t indexB) const;
  double slowOf(const Encounter& encounter, std::size_t indexA, std::size_t indexB) const;
  double knownTo(const Encounter& encounter, std::size_t indexA, std::size_t indexB) const;
  void joinPoints(const Encounter& encounter, std::size_t index, ImpactContact& contact) const;
  void resolve(Encounter& encounter);
  void record(const Encounter& encounter);
  void record(const ContactGroup& contactGroup);

  // Position correction and contacts to consider.
  void alignPlaces(Encounter& encounter, const Event& event) const;
  void addHeld(const Encounter& encounter, std::vector<ContactFeature>& features) const;
  void addCorners(const Encounter& encounter, std::vector<ContactFeature>& features) const;
  void addMeeting(const Encounter& encounter, std::size_t a, std::size_t b,
                  std::vector<ContactFeature>& features) const;
  void addOverlaps(const Encounter& encounter, std::vector<ContactFeature>& features) const;
  BoxAt boxOf(const Encounter& encounter, std::size_t index) const;
  double gapOf(const Encounter& encounter, std::size_t a, std::size_t b) const;
  static std::size_t indexOf(const Encounter& encounter, int rank);

  // The next motion: Flight, Contact or Rest.
  void findChattering(Encounter& encounter);
  void settle(Encounter& encounter);
  void settleBody(Encounter& encounter, std::size_t index, const Load& load) const;
  void findPersisting(Encounter& encounter) const;
  void choose(Encounter& encounter, std::size_t contact, const Vec3& velocity) const;
  struct Parting {
    double speed = 0;              ///< [m/s] rate of the gap
    double rounding = 0;           ///< [m/s] up to this it counts as zero
    Vec3 velocity = Vec3::Zero();  ///< [m/s] of a's point relative to b's
  };
  Parting partingAt(const Encounter& encounter, std::size_t contact) const;
  void formIslands(Encounter& encounter) const;
  std::vector<ContactFeature> featuresOf(const Encounter& encounter, const std::vector<std::size_t>& members,
                                         std::vector<std::size_t>& indices) const;
  void formIsland(Encounter& encounter, const std::vector<std::size_t>& members) const;
  bool beginsAtRest(Island& island, int timeSteps, double slow) const;
  TouchingBody touchingBody(const Encounter& encounter, std::size_t index) const;
  ContactFeature featureOf(const Encounter& encounter, std::size_t contact) const;
  double lengthsAt(const Encounter& encounter, std::size_t k) const;
  double hopRounding(const Encounter& encounter, std::size_t index, std::size_t k) const;
  bool isForced(int rank) const { return forced_[static_cast<std::size_t>(rank)] != 0; }

  void advance(const std::shared_ptr<ContactGroup>& contactGroup, const Instant& time);
  static bool seesTo(const ContactGroup& contactGroup, std::size_t place, int rank);
  void fly(int rank, const Instant& time, const BodyState& state, const Quat& attitude);
  void stand(const Encounter& encounter, std::size_t index);
  void rest(int rank, const Instant& time, const Pose& pose);
  void touch(const std::shared_ptr<ContactGroup>& contactGroup, const Instant& time);
  bool step(ContactGroup& contactGroup, const Instant& time);
  double withinCell(double speed) const;
  /// [m/s] gained by falling, or being pulled, through the tolerance; where nothing pulls that takes for
  /// ever.
  double fallSpeed(const Encounter& encounter) const {
    return encounter.pull > 0 ? encounter.pull * timeScale_ : 0;
  }
  void begins(int rank, const Instant& time);
  void arrive(const Mover& body, const Instant& time, const BodyState& state);

  void predict(int rank);
  void predictAround(int rank);
  static void sooner(std::optional<Event>& first, const Event& candidate);
  void findCrossing(Mover& body, int rank);

  Mover& mover(int rank) { return movers_[static_cast<std::size_t>(rank)]; }
  const Mover& mover(int rank) const { return movers_[static_cast<std::size_t>(rank)]; }
  std::string where(int rank, const Instant& time) const;

  const World& world_;
  Instant end_;
  double workShare_ = 0;  // [1] of the work per body above that each may spend
  double tolerance_;      // [m]
  CrowdSettings crowds_;
  std::shared_ptr<Team> team_;  // of all crowds
  double timeScale_;            // [s] see timeScaleOf
  double longestStep_;          // [s] of an island
  Recorder& recorder_;
  std::vector<Mover> movers_;
  Neighbors neighbors_;
  EventQueue queue_;
  FlightAccount account_;
  std::vector<Neighbors::Key> candidates_;
  std::vector<char> forced_;               // by rank: springs or drag act on it, so it is never in Flight
  std::vector<std::vector<int>> springs_;  // by rank: bodies attached to it by springs
};

}  // namespace careen
