#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "physics/pile/body.h"
#include "physics/pile/manifold.h"
#include "physics/pile/solver.h"
#include "physics/solver/displacement_solver.h"

namespace careen {

/// Position projection: removes penetration without friction and without changing any velocity or angular
/// momentum: the smallest mass-weighted displacement δ with gap + J·δ ≥ 0 for the manifolds around those that
/// penetrate by more than a tolerance. Linear in δ, hence iterated in passes with gaps updated in between:
/// the first few by Gauss–Seidel, as most need no more, and few bodies move; those after them by accelerated
/// gradients.
///
/// Or it holds bodies where the smallest displacement is long, or there is none, as among wedged boxes: then
/// gap + J·δ ≥ nearly what the gap was before the step, by gradients from the first pass on. There always is
/// nearly such a displacement, the way back.
///
/// It costs what there is to be done: of manifolds that were not looked at, only those around deep ones are
/// brought up to date; those that it holds are many more.
class PileProjection {
 public:
  /// `tolerance` [m] of the crowd: penetration of less than that remains, and of tiny boxes less.
  PileProjection(double tolerance, std::shared_ptr<Team> team)
      : tolerance_(tolerance), team_(team), solver_(team), gradients_(std::move(team)) {}

  /// [1] of the tolerance: penetration kept, so that contacts persist.
  static constexpr double kLeft = 1.0 / 3;

  enum class Look { kFirst, kAgain };  ///< at a manifold in this projection
  /// Brings a manifold's gaps to where its bodies are. Called by several threads.
  using Refresh = std::function<void(PileManifold& manifold, Look look)>;
  /// Brings the gaps of a copy of a manifold to where its bodies were before the step.
  using TakeBack = std::function<void(PileManifold& manifold)>;

  /// A projection of these bodies, by the manifolds with the slots `near`. All must stay where they are until
  /// the last pass. With `takeBack`, it holds them.
  void begin(std::span<PileBody> bodies, std::span<PileManifold> manifolds, std::span<const int> near,
             Refresh refresh, TakeBack takeBack = {});
  bool holds() const { return takeBack_ != nullptr; }
  /// At one manifold, by index in near, or at all.
  void lookAt(std::size_t n);
  void lookAtAll();
  /// At those that were, after they were changed.
  void lookAgain();
  /// [m] Deepest penetration of all that were looked at.
  double deepest() const;

  /// One pass; `number` counts those before it. Only penetrating bodies and a few layers of neighbours move,
  /// more from pass to pass. False if nothing was to be done.
  bool pass(int number);

  /// [m] For boxes of that smallest size [m].
  double tolerated(double length) const { return std::min(tolerance_, 0x1.8p-8 * length); }

  /// [m] How far the last pass moved points, at the most.
  double farthest() const { return farthest_; }
  /// The bodies that it moved.
  const std::vector<int>& moved() const { return moved_; }

 private:
  struct Seen {        // of a manifold
    double depth = 0;  // [m]
    bool everSeen = false;
    bool upToDate = false;
    bool deep = false;   // too deep to stay
    bool close = false;  // what is moved on one side may push the other
  };
  void listNearOfBodies();
  bool collect(int layers);
  void reach(const PileManifold& manifold);
  void fillSolver();
  void solve(int number);
  void move();
  void moveBody(int body);

  double tolerance_;     // [m]
  double farthest_ = 0;  // [m]
  std::shared_ptr<Team> team_;
  std::span<PileBody> bodies_;
  std::span<PileManifold> manifolds_;
  std::span<const int> near_;
  Refresh refresh_;
  TakeBack takeBack_;
  PileSolver solver_;
  DisplacementSolver gradients_;
  std::vector<Seen> seen_;            // by index in near_
  std::vector<std::size_t> firstOf_;  // by body: in nearOf_; empty until a pass needs it
  std::vector<std::size_t> nearOf_;   // indices in near_
  std::vector<char> isReached_;       // by body: moves in this pass
  std::vector<int> reached_;          // these
  std::vector<char> isChosen_;        // by index in near_
  std::vector<std::size_t> chosen_;   // these
  std::vector<int> moved_;
};

}  // namespace careen
