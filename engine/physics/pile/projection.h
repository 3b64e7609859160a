#pragma once

#include <span>
#include <vector>

#include "physics/pile/body.h"
#include "physics/pile/manifold.h"
#include "physics/pile/solver.h"

namespace careen {

/// Takes overlap out of the positions, without friction and without touching a velocity or an angular
/// momentum: the smallest movement, weighed by mass, with gap + J·δ ≥ 0 for the manifolds around those that
/// overlap by more than a tolerance. Linear in δ: so it is done in passes, gaps taken anew between them.
class PileProjection {
 public:
  /// [1] of the smaller box's smallest size: what is left alone. 2e-4 m for boxes of 0.4 m.
  static constexpr double kTolerance = 0x1p-11;

  /// One pass over the listed manifolds, whose gaps must be up to date. Only bodies that overlap and their
  /// neighbours, in so many layers (at most 127), give way. False if nothing was to be done.
  bool pass(std::span<PileBody> bodies, std::span<PileManifold> manifolds, std::span<const int> near,
            int layers);

  bool moved(int body) const { return moved_[static_cast<std::size_t>(body)] != 0; }

 private:
  bool collect(std::span<const PileBody> bodies, std::span<PileManifold> manifolds, std::span<const int> near,
               int layers);

  PileSolver solver_;
  std::vector<char> reached_;
  std::vector<char> moved_;
  std::vector<int> chosen_;
};

}  // namespace careen
