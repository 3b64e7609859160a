#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/disjoint_sets.h"
#include "core/system/team.h"
#include "physics/geometry/box_at.h"
#include "physics/motion/hermite_step.h"
#include "physics/pile/body.h"
#include "physics/pile/manifold.h"
#include "physics/pile/pairs.h"
#include "physics/pile/projection.h"
#include "physics/pile/solver.h"
#include "physics/solver/contact_solver.h"
#include "physics/world/forces.h"
#include "physics/world/world.h"

namespace careen {

/// Many boxes in contact that advance together in steps: the fast kind of contact group, of bounded error.
/// Not exact: impacts are placed at the ends of steps, and the impulses of more than a few hundred contact
/// points come from a Gauss–Seidel solver that stops early; those of fewer from the ContactSolver, but in
/// violent motion, where it takes too long. What
/// holds: linear momentum is exchanged to rounding, restitution adds no energy, penetration stays near
/// `tolerance`, and members at rest cost nothing.
///
/// A step consists of: broad and narrow phase; gravity, springs and drag; solve for impulses such that no gap
/// becomes negative within the step, v_n ≥ −(gap + its second order, of bodies that turn)/h; integrate
/// positions; restitution. The velocities solved for are those of the middle of the step, and forces act from
/// the middle of one step to that of the next (leapfrog); those of springs and drag are those in the middle
/// of each step, for all members alike, so that they keep momentum. Where one point of a manifold strikes,
/// all its points within a few tolerances strike, with v_n ≥ 0: else the corners of one edge would strike in
/// different steps, and each would turn the body. Bodies that went deep into each other in a step, or into a
/// wall, are pushed apart at its end, with those around them; where they are too deep for that, it is taken
/// again with half its length, and with more sweeps where it gained energy; where there is no place for them,
/// as among wedged boxes, they are held about as deep as they were before it. Penetration that is left at the
/// rates found is undone by shifts in the same step, the rest by a position projection every few steps; none
/// of it becomes velocity (no Baumgarte stabilisation, no slop).
///
/// Bodies sleep with all that they touch, or, where some of that still moves, beyond a few contacts from it,
/// if forces within their cones balance on them at rest, those of the ones awake being as they are: then
/// until what the ones awake push them with changes by kMayChange of that and their weight.
///
/// `tolerance` [m] scales all of it: the length of steps with its root, penetration in proportion.
///
/// Members are added and removed at any time; they are identified by places, in the order in which they came.
/// A place that was left is used again.
///
/// Known limits. A box spinning on a single contact point has no torsional friction to stop it and keeps
/// everything it touches awake. Position projection lifts the bodies above: in 99 of 100 small pours the
/// energy rose by less than 2e-5 of the initial energy per 1/60 s, in the last one, a shaft of 38 layers, by
/// 5e-4.
///
/// A member that nothing touches follows its parabola to rounding; its attitude has an error of O(h³).
class Crowd {
 public:
  /// [m] What penetration and steps were measured for.
  static constexpr double kUsualTolerance = 3e-4;

  /// The steps of large crowds are shared among the team; nothing else depends on its size.
  Crowd(const World& world, double tolerance, std::shared_ptr<Team> team = std::make_shared<Team>(1));

  /// Adds a body of the world, by its index in it; returns its place. `past` [s] is that of JoinedSteps: how
  /// long its last step was.
  std::size_t admit(std::size_t body, const BodyState& state, const Quat& attitude,
                    double past = std::numeric_limits<double>::max());
  /// Adds one that sleeps until it is pushed, together with its `cluster`: a place, perhaps its own.
  std::size_t admitAtRest(std::size_t body, const Pose& pose, std::optional<std::size_t> cluster);
  void dismiss(std::size_t place);

  /// Advances by one step of at most `most` [s] and returns its length.
  double step(double most);
  /// Takes the last step again with that length [s], shorter than it was, and with those admitted since, who
  /// begin where it began. Returns its length, perhaps shorter still.
  double stepAgain(double length);

  /// [s] What step() would take.
  double nextLength(double most) const { return std::min(chooseLength(), most); }
  /// [m/s] Of the fastest member, its centre.
  double fastest() const;
  /// The space that members that are awake or asleep can reach within that time [s].
  struct Extent {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::max());
    Vec3 high = Vec3::Constant(-std::numeric_limits<double>::max());
    void include(const Vec3& center, double radius);
  };
  Extent extent(double length) const;
  /// The space that the last step took.
  Extent swept() const;
  /// Whether a member came that near [m] to a box, as far as that can be said before a search.
  bool cameNear(std::size_t place, BoxAt box, double distance) const;

  bool isHeld(std::size_t place) const { return bodies_[place].held; }
  /// Asleep: its pose is bitwise constant until another body pushes it.
  bool sleeps(std::size_t place) const { return bodies_[place].asleep; }
  BodyState state(std::size_t place) const { return stateOf(bodies_[place]); }
  /// With the velocity that forces give it until where it is.
  BodyState stateAtEnd(std::size_t place) const;
  /// Where it had the velocity of state(), half a step ago if it was pushed: so its energy is that of one
  /// moment.
  BodyState stateAtVelocity(std::size_t place) const;
  const Quat& attitude(std::size_t place) const { return bodies_[place].attitude; }
  const PileBody& body(std::size_t place) const { return bodies_[place]; }
  const Body& listedBody(std::size_t place) const { return world_.bodies[listed_[place]]; }
  /// Whether it moved in the last step; then where that step began and ended. Where something pushed it, it
  /// moves straight and both ends have the mean velocity; `asItCame`: but for the begin.
  bool moved(std::size_t place) const { return before_[place].moved; }
  StepEnd begin(std::size_t place, bool asItCame = false) const;
  /// By place, of the last step: whether its velocity changed by more than lasting forces do, or that of one
  /// which it pushed, directly or through others.
  std::vector<char> changedSuddenly() const;
  StepEnd end(std::size_t place) const;
  double length() const { return h_; }
  /// Its begin is to be met: JoinedSteps would lead members through each other there.
  bool isSharp() const { return isSharp_; }
  /// Nothing was near it for a few steps.
  bool isFree(std::size_t place) const { return untouchedSteps_[place] > kStepsAlone; }
  /// All members are asleep or fixed.
  bool atRest() const { return atRest_; }
  /// [m] The deepest that was seen and left, by a projection or as not deep enough for one, in the steps that
  /// were taken.
  double deepest() const { return deepest_; }
  /// [m] Deepest current penetration, by all 15 axes of every pair: costs more than a step.
  double penetration() const;

  /// An impact of the last step: one contact point.
  struct Struck {
    int a = 0;                    ///< place
    Partner b = {};               ///< place or wall
    Vec3 point = Vec3::Zero();    ///< [m] world
    Vec3 normal = Vec3::UnitZ();  ///< [1] from b to a
    double approach = 0;          ///< [m/s]
    double impulse = 0;           ///< [N s]
    double tangential = 0;        ///< [N s]
  };
  /// Of the solves of steps since it was last asked, before bounces and shifts.
  ContactResiduals takeResiduals() { return std::exchange(residuals_, {}); }
  const std::vector<Struck>& impacts() const { return impacts_; }

  struct Figures {
    std::int64_t steps = 0;
    std::int64_t retaken = 0;      ///< times that one was taken again
    std::int64_t pairs = 0;        ///< tested, over all steps
    std::int64_t manifolds = 0;    ///< refreshed
    std::int64_t rebuilt = 0;      ///< of these, rebuilt
    std::int64_t rows = 0;         ///< contact points in the solver
    std::int64_t solves = 0;       ///< manifold solves, over all sweeps
    std::int64_t projections = 0;  ///< passes
    std::int64_t frozen = 0;       ///< bodies put to sleep
    std::int64_t woken = 0;
  };
  const Figures& figures() const { return figures_; }

 private:
  /// [1] relative to gravity: tolerated force imbalance of a body at rest.
  static constexpr double kFeasible = 0x1p-10;
  /// [1] of a body's weight and of what another pushes it with: change of the latter that wakes it.
  static constexpr double kMayChange = 0x1p-3;
  /// [1] of the same: change that is a strike, to which it must not have been a wall.
  static constexpr double kStrike = 4;
  static constexpr int kStepsAlone = 2;
  static constexpr double kMostBent = 6;  // [1] of the tolerance: how far corners may leave their tangents
  static constexpr std::size_t kFewRows = 150;       // up to which they are always solved directly
  static constexpr double kLongestStep = 1.0 / 180;  // [s] at the usual tolerance
  double longestStep() const { return kLongestStep * scale_; }
  struct Bounce {
    int row = 0;
    double speed = 0;     // [m/s] separation speed
    double approach = 0;  // [m/s]
    double fall = 0;      // [m/s] by which forces change the normal speed in the step
    int slot = 0;         // manifold
    int point = 0;        // of it
  };
  struct Before {  // a body at the start of the step, and its velocities at the end before it bounces
    Vec3 position = Vec3::Zero();
    Quat attitude = Quat::Identity();
    Vec3 velocity = Vec3::Zero();
    Vec3 omega = Vec3::Zero();
    Vec3 angularMomentum = Vec3::Zero();
    Vec3 endVelocity = Vec3::Zero();
    Vec3 endOmega = Vec3::Zero();
    bool pushed = false;
    bool projected = false;
    bool moved = false;
  };
  struct Kinetic {  // [J] energy of a body, before impulses and after
    double before = 0;
    double after = 0;
  };
  struct Kept {  // a body before a pass of the projection
    Vec3 position = Vec3::Zero();
    Quat attitude = Quat::Identity();
    double path = 0;    // [m]
    double turned = 0;  // [m]
  };
  enum class Looked : char { kNot, kFar, kBare, kNear };  // kBare: near, but its manifold has no points
  struct Looking {                                        // at a range of pairs
    PileManifold tried;  // of a pair that has no slot: most are far, so this stays in the cache
    std::vector<std::pair<std::size_t, PileManifold>> begun;  // of those that are not; by index
    std::vector<std::size_t> left;                            // those that became far
    std::vector<std::size_t> besideSleep;
    std::int64_t pairs = 0;
    std::int64_t rebuilt = 0;
  };
  struct Rates {  // of the way in a part of a step
    Vec3 velocity = Vec3::Zero();
    Vec3 omega = Vec3::Zero();
  };
  Vec3 meanSpin(std::size_t place) const;
  bool changesSuddenly(std::size_t place) const;
  /// Work that the team shares: work(manifold, index in near_) for those near, which must not write to what
  /// others read.
  template <class Work>
  void forNear(const Work& work) {
    team_->share(near_.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        work(manifolds_[at(near_[k])], k);
      }
    });
  }
  /// The same for places of bodies.
  template <class Work>
  void forPlaces(const Work& work) {
    team_->share(bodies_.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        work(i);
      }
    });
  }
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const PileBody& bodyAt(Partner partner) const { return bodies_[at(partner.body())]; }
  const Wall& wallAt(Partner partner) const { return world_.walls[partner.wall()]; }

  std::size_t place(const PileBody& body, std::size_t listed);
  void limitBySprings(std::size_t listed);
  void sortManifolds();
  double chooseLength() const;
  void take(double length, bool mayShift = true);
  double keepApart();
  double kineticEnergy(std::size_t place) const;
  bool gainedEnergy() const;
  void goBack();
  void findLoads();
  Vec3 acceleration(std::size_t place) const;
  Vec3 accelerationBefore(std::size_t place) const;
  Vec3 halfKick(std::size_t place) const { return bodies_[place].behind * acceleration(place); }
  Vec3 torque(std::size_t place) const;
  Vec3 torqueBefore(std::size_t place) const;
  double slowestBounce(const PileManifold& manifold) const;
  void lookAround();
  bool isClear(const PilePair& pair) const;
  double wayLeft(const PilePair& pair) const;
  double wayAhead(const PilePair& pair) const;
  double rebuildAfter(double length) const;
  Looked lookAt(PilePair& pair, PileManifold& manifold, std::int64_t& rebuilt) const;
  void lookAtAll();
  bool wouldPush(const PilePair& pair, const PileManifold& manifold) const;
  void wakeCluster(int cluster);
  void wakeNeighbours();
  bool isAsleep(Partner partner) const { return !partner.isWall() && bodyAt(partner).asleep; }
  bool isHalfAsleep(const PileManifold& manifold) const;
  static Vec3 forceOf(const PileManifold& manifold);
  bool isQuiet(std::size_t place, double imbalance, double part) const;
  static Vec3 impulseOf(const PileManifold& manifold, int k);
  void addPresentRows(const PileManifold& manifold);
  void freezeParts();
  void keepFar(std::vector<char>& marked) const;
  void certify(std::vector<char>& chosen);
  void restoreImpulses(const std::vector<int>& slots, const std::vector<char>& sleeping);
  void findDisturbed();
  void wakeDisturbed();
  bool wakeStruck();
  double loadBody(std::size_t place);
  void loadSolver();
  void solve();
  bool isHeavy() const;
  bool solveDirectly();
  void addImpulses(double sign);
  void limitBounce();
  void findPushing();
  PileSolver::Extent lookForRows(PileManifold& manifold) const;
  void addRows(PileManifold& manifold, PileSolver::Extent first);
  void addBounces(const PileManifold& manifold, int slot);
  bool curveGaps();
  Vec3 spinRate(int body) const;
  double secondOrder(const PileManifold& manifold, int k) const;
  void keepImpulses();
  void findShifts();
  void move();
  void bounce();
  void noteImpacts();
  void refreshNear();
  void takeVelocity(PileBody& body, int index);
  void turnUnderLoad(PileBody& body, std::size_t place) const;
  void countUntouched();
  double newDepth();
  double shiftOf(int body) const;
  double depthNow(const PilePair& pair) const;
  double wayOf(int b, int a) const;
  void findTurns();
  double gapAtEnd(int a, int b, int axis) const;
  bool staysApart(int a, int b, int axis) const;
  double depthWithin(int a, int b, int axis, double atEnd) const;
  Pose between(std::size_t place, double part) const;
  double depthBefore(const PilePair& pair) const;
  bool startedDeep(const PilePair& pair) const;
  enum class Aim { kApart, kHold };
  void beginProjection(Aim aim);
  void refreshGaps(PileManifold& manifold, bool first);
  void takeBackGaps(PileManifold& manifold) const;
  void projectAll();
  double project(int passes);
  double deepestBefore() const;
  void keepPlaces();
  void restorePlaces();
  void rebuildNear();
  bool lookAtDeep(Aim aim);
  bool mend();
  bool tryToMend();
  double projectOnWay();
  Rates meanRates(std::size_t place) const;
  double pastOf(std::size_t place) const { return std::min(past_[place], hBefore_); }
  void findSharp();
  double deepestOnWay();
  bool freeze();
  void beginManifold(const PilePair& pair, PileManifold& manifold) const;
  void keepManifold(PilePair& pair, const PileManifold& manifold);

  const World& world_;
  std::shared_ptr<Team> team_;
  double tolerance_;                 // [m]
  double scale_;                     // [1] root of the tolerance over the usual one
  double gravityMagnitude_ = 0;      // [m/s²]
  double springLimit_ = 0;           // [s] longest step with the springs of the members
  double h_ = 0;                     // [s] of the last step
  double hBefore_ = 0;               // [s] of the one before
  double chosen_ = 0;                // [s] what the last one would be if nothing outside cut it
  double span_ = 0;                  // [s] from the middle of that to the middle of the last: its impulses
  double sinceProjection_ = 0;       // [s]
  std::vector<PileBody> bodies_;     // by place
  std::vector<std::size_t> listed_;  // by place: index in the world
  std::vector<Before> before_;
  std::vector<PileBody> start_;  // bodies_ at the start of the last step
  std::vector<Vec3> turns_;      // [rad] by place, in the last step
  std::vector<double> paths_;    // [m] by place: of its body, up to where pairs are looked at
  std::vector<int> untouchedSteps_;
  std::vector<int> free_;               // places that were left
  std::vector<BodyState> worldStates_;  // for springs and drag
  std::vector<Load> loads_;             // by index in the world, in the last step
  std::vector<Load> loadsBefore_;       // in the step before it

  PilePairs pairs_;
  std::vector<PileManifold> manifolds_;
  std::vector<PileManifold> sorted_;        // before they take the place of the others
  std::vector<int> unused_;                 // free slots of manifolds_
  std::vector<int> near_;                   // manifolds of this step, by key
  std::vector<PileSolver::Extent> rowsOf_;  // by index in near_: where its own begin
  std::vector<char> strike_;                // by the same: whether a point of it strikes
  std::vector<Looked> looked_;              // by pair
  std::vector<Looking> looking_;            // by range of pairs
  std::vector<std::size_t> besideSleep_;    // pairs that are near, of which one sleeps, or did until now
  std::vector<char> isDeep_;                // by pair: after this step
  PileSolver solver_;
  ContactProblem problem_;
  ContactSolution solution_;
  ContactSolver direct_;
  std::int64_t effort_ = 1;  // [1] of the usual sweeps
  int directWait_ = 0;       // solves until it is tried again,
  int directPause_ = 1;      // and as many after the next failure
  PileProjection projection_;
  std::vector<Kept> kept_;          // where it left bodies least deep in each other
  int mendingWait_ = 0;             // steps until mending is tried again,
  int mendingPause_ = 0;            // and as many after the next failure
  double projected_ = 0;            // [m] how far it moved one in this step, at the most
  std::vector<Rates> ratesBefore_;  // by place, at the end of the step before
  std::vector<double> past_;        // [s] by place: its last step, of who was no member then, or more
  bool isSharp_ = false;
  double bent_ = kMostBent;  // [1] of the tolerance: the same in the next step, at the most
  double tell_;              // [1] of the smallest size: change per step above which neighbours are re-solved
  std::vector<char> bends_;  // by place: its corners leave their tangents in this step
  std::vector<Kinetic> kinetic_;  // by place
  std::vector<Bounce> bounces_;
  std::vector<Struck> impacts_;
  std::vector<double> unrest_;    // [m/s] net velocity change of the last step
  std::vector<double> pushing_;   // [m/s] largest speed of a body and of those near it
  std::vector<double> grip_;      // [1] largest friction coefficient at a body's contacts
  DisjointSets clusters_;         // of bodies in resting contact
  std::vector<int> quietChecks_;  // by place: since when it and all that is near it could sleep
  int checks_ = 0;                // of parts of clusters
  std::vector<char> woken_;       // by place: in this step
  std::vector<int> disturbed_;    // clusters that the last step pushed otherwise than when they fell asleep
  bool shifts_ = false;           // in this step
  bool atRest_ = false;
  double deepest_ = 0;
  double left_ = 0;    // [m] by the last projection
  double undone_ = 0;  // [m] how deep those are, in this step, whom none pushed
  ContactResiduals residuals_;
  double speed_ = 0;  // [m/s] largest of its bodies, before impulses: S of the residuals
  Figures figures_;
};

}  // namespace careen
