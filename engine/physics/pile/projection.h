#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "physics/pile/body.h"
#include "physics/pile/displacement_solver.h"
#include "physics/pile/manifold.h"
#include "physics/pile/solver.h"

namespace careen {

/// Position projection: removes penetration without friction and without changing any velocity or angular
/// momentum: the smallest mass-weighted displacement δ with gap + J·δ ≥ 0 for the manifolds around those that
/// penetrate by more than a tolerance. Linear in δ, hence iterated in passes with gaps updated in between:
/// the first few by Gauss–Seidel, as most need no more, and few bodies move; those after them by accelerated
/// gradients.
class PileProjection {
 public:
  /// `tolerance` [m] of the crowd: penetration of less than that remains, and of tiny boxes less.
  PileProjection(double tolerance, std::shared_ptr<Team> team)
      : tolerance_(tolerance), solver_(team), gradients_(std::move(team)) {}

  /// One pass over the listed manifolds, whose gaps must be up to date; `number` counts those before it. Only
  /// penetrating bodies and a few layers of neighbours move, more from pass to pass. False if nothing was to
  /// be done.
  bool pass(std::span<PileBody> bodies, std::span<PileManifold> manifolds, std::span<const int> near,
            int number);

  /// [m] For boxes of that smallest size [m].
  double tolerated(double length) const { return std::min(tolerance_, 0x1.8p-8 * length); }

  /// [m] How far the last pass moved points, at the most.
  double farthest() const { return farthest_; }

  bool moved(int body) const { return moved_[static_cast<std::size_t>(body)] != 0; }

 private:
  bool collect(std::span<const PileBody> bodies, std::span<PileManifold> manifolds, std::span<const int> near,
               int layers);
  void solve(std::span<const PileBody> bodies, int number);

  double tolerance_;     // [m]
  double farthest_ = 0;  // [m]
  PileSolver solver_;
  DisplacementSolver gradients_;
  std::vector<char> reached_;
  std::vector<char> moved_;
  std::vector<int> chosen_;
};

}  // namespace careen
