#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/disjoint_sets.h"
#include "physics/pile/body.h"
#include "physics/pile/manifold.h"
#include "physics/pile/pairs.h"
#include "physics/pile/projection.h"
#include "physics/pile/solver.h"
#include "physics/world/world.h"

namespace careen {

/// Many boxes in contact, advanced in fixed frames: the fast, bounded-error regime. Not exact: contact forces
/// come from a Gauss–Seidel solver that stops early. Guarantees: penetration stays small at every frame,
/// impulses add no energy, and bodies at rest cost nothing.
///
/// A frame consists of substeps, each: broad and narrow phase; gravity; solve for impulses such that no gap
/// becomes negative within the substep at its current rate, v_n ≥ −gap/h; integrate positions. Remaining
/// penetration is removed by a position projection at the end of the frame and never becomes velocity (no
/// Baumgarte stabilisation, no slop).
///
/// Measured with 1000 boxes of 0.4 to 0.6 m falling into a pit from up to 29 m, μ = 0.5, at every frame of
/// 1/60 s: deepest penetration 8e-4 m during the fall, 2e-4 m at the end, all asleep after 6 s.
///
/// Known limits. A box spinning on a single contact point has no torsional friction to stop it and keeps
/// everything it touches awake. Position projection lifts the bodies above: in 99 of 100 small pours the
/// energy rose by less than 2e-5 of the initial energy in any frame, in the last one, a shaft of 38 layers,
/// by 5e-4.
///
/// In free flight the centre is exact to rounding, the attitude to O(h³). Springs and drag of the world are
/// ignored. Fixed bodies do not move.
class Pile {
 public:
  /// `states`: one per body of the world, in its order. `frame` [s]. Bodies are processed in order of their
  /// names: their order in the world changes no bit of the result.
  Pile(const World& world, std::vector<BodyState> states, double frame);

  /// Advances by one frame.
  void step();
  /// States after the last step, in the world's order.
  std::span<const BodyState> states() const { return states_; }

  /// Asleep: its pose is bitwise constant until another body pushes it.
  bool sleeps(int body) const { return bodies_[rankOf_[at(body)]].asleep; }
  /// All bodies are asleep or fixed; step() then costs nothing.
  bool atRest() const { return atRest_; }
  /// [m] Deepest current penetration between two bodies, or a body and a wall. Tests all 15 axes of every
  /// pair: costs more than a step.
  double deepest() const;

  struct Figures {
    std::int64_t frames = 0;
    std::int64_t substeps = 0;
    std::int64_t pairs = 0;        ///< tested, over all substeps
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
  struct Bounce {
    int row = 0;
    double speed = 0;  // [m/s] separation speed
  };
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const PileBody& bodyAt(Partner partner) const { return bodies_[at(partner.body())]; }
  const Wall& wallAt(Partner partner) const { return walls_[partner.wall()]; }

  void sortManifolds();
  int chooseSubsteps();
  void substep(double lookAhead);
  void lookAround(double time);
  bool lookAt(PilePair& pair);
  bool wouldPush(const PilePair& pair, const PileManifold& manifold) const;
  void wakeCluster(int cluster);
  void loadSolver();
  void solve();
  void addRows(PileManifold& manifold);
  void keepImpulses();
  void move();
  void bounce();
  void refreshNear();
  void takeVelocity(PileBody& body, int index);
  void project();
  bool freeze();
  PileManifold& manifoldOf(PilePair& pair);

  Vec3 gravity_;
  double gravityMagnitude_ = 0;  // [m/s²] |gravity|
  std::vector<Wall> walls_;
  double frame_;
  double h_;                         // [s] time step of a substep
  double impulseScale_ = 1;          // scales stored impulses to this substep
  std::vector<std::size_t> rankOf_;  // rank of each of the world's bodies
  std::vector<PileBody> bodies_;     // by rank
  std::vector<std::size_t> bodyOf_;  // body of each rank
  std::vector<BodyState> states_;

  PilePairs pairs_;
  std::vector<PileManifold> manifolds_;
  std::vector<int> unused_;  // free slots of manifolds_
  std::vector<int> near_;    // manifolds of this substep, by key
  std::vector<char> looked_;
  PileSolver solver_;
  PileProjection projection_;
  double tell_;  // [1] of the smallest size: change per substep above which neighbours are re-solved
  std::vector<Bounce> bounces_;
  std::vector<double> unrest_;  // [m/s] net velocity change of the last substep
  std::vector<double> grip_;    // [1] largest friction coefficient at a body's contacts
  DisjointSets clusters_;       // of bodies in resting contact
  bool atRest_ = false;
  Figures figures_;
};

}  // namespace careen
