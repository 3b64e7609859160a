#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "physics/pile/crowd_members.h"
#include "physics/pile/manifold.h"
#include "physics/pile/pairs.h"
#include "physics/pile/solver.h"

namespace careen {

/// [1] of what forces give in a step: slower approach is no impact.
inline constexpr double kStrikesFrom = 4;
/// [1] of the tolerance: points that near meet together.
inline constexpr double kTogether = 3;

/// Contacts of a crowd, by broad and narrow phase: pairs of members, and the manifolds of those that may
/// touch in the step.
class CrowdContacts {
 public:
  explicit CrowdContacts(CrowdMembers& members);

  void clearPlace(std::size_t place) { pairs_.clearPlace(static_cast<int>(place)); }

  /// Stores manifolds in processing order, for cache locality with thousands of boxes. The storage order does
  /// not affect results.
  void sort();

  /// Contacts of a step: begin(), lookAtAll(), again after some were woken, listNear().
  void begin();
  /// At pairs of which one moves, but for those that were looked at in this step.
  void lookAtAll();
  void listNear();

  const std::vector<PilePair>& pairs() const { return pairs_.pairs(); }
  /// Whether that pair is near in this step.
  bool isNear(std::size_t pair) const { return looked_[pair] == Looked::kNear; }
  /// Pairs that are near, of which one sleeps, or did until now; after listNear() in their order.
  const std::vector<std::size_t>& besideSleep() const { return besideSleep_; }
  /// Manifolds of this step, by slots in the order of their pairs.
  const std::vector<int>& near() const { return near_; }
  std::span<PileManifold> manifolds() { return manifolds_; }
  std::size_t manifoldCount() const { return manifolds_.size(); }
  PileManifold& operator[](int slot) { return manifolds_[at(slot)]; }
  const PileManifold& operator[](int slot) const { return manifolds_[at(slot)]; }
  /// Of a pair's manifold, as in BoxAxis, or −1.
  int axisOf(const PilePair& pair) const { return pair.slot < 0 ? -1 : (*this)[pair.slot].axis; }

  /// Whether the two have not moved enough, along the paths up to where pairs are looked at, to have contact
  /// points: the first look.
  bool isClear(const PilePair& pair) const;
  /// [m] By how much the two may still come nearer than when they were last looked at, at the least, before
  /// there can be contact points.
  double wayLeft(const PilePair& pair) const;
  /// From now on pairs are looked at where bodies are.
  void endPaths();

  /// [m] Relative motion after which a manifold of boxes of that smallest size [m] is rebuilt.
  double rebuildAfter(double length) const;
  /// Updates gaps to the poses of now, or of these bodies, without rebuilding.
  void refresh(PileManifold& manifold) const { refresh(manifold, members_.bodies); }
  void refresh(PileManifold& manifold, const std::vector<PileBody>& bodies) const;
  /// Those of this step, when they are looked at next.
  void rebuildNear();
  /// Members were moved by no more than that [m], by place.
  void displaced(std::span<const double> by);
  /// Rows of those points that have one, at the gaps and with the impulses of now.
  void addPresentRows(const PileManifold& manifold, PileSolver& solver) const;

  /// work(manifold, index in near()), which the team shares; must not write to what others read.
  template <class Work>
  void forNear(const Work& work) {
    members_.team->share(near_.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        work(manifolds_[at(near_[k])], k);
      }
    });
  }

 private:
  enum class Looked : char { kNot, kFar, kBare, kNear };  // kBare: near, but its manifold has no points
  struct Looking {                                        // at a range of pairs
    PileManifold tried;  // of a pair that has no slot: most are far, so this stays in the cache
    std::vector<std::pair<std::size_t, PileManifold>> begun;  // of those that are not; by index
    std::vector<std::size_t> left;                            // those that became far
    std::vector<std::size_t> besideSleep;
  };
  void lookAt(std::size_t pair, Looking& looking);
  Looked lookAt(PilePair& pair, PileManifold& manifold) const;
  double wayAhead(const PilePair& pair) const;
  void beginManifold(const PilePair& pair, PileManifold& manifold) const;
  void keepManifold(PilePair& pair, const PileManifold& manifold);

  CrowdMembers& members_;
  PilePairs pairs_;
  std::vector<PileManifold> manifolds_;
  std::vector<PileManifold> sorted_;  // before they take the place of the others
  std::vector<int> unused_;           // free slots of manifolds_
  std::vector<int> near_;
  std::vector<Looked> looked_;    // by pair
  std::vector<Looking> looking_;  // by range of pairs
  std::vector<std::size_t> besideSleep_;
  std::vector<double> paths_;  // [m] by place: of its body, up to where pairs are looked at
};

}  // namespace careen
