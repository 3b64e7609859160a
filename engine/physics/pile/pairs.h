#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/pile/body.h"
#include "physics/world/partner.h"

namespace careen {

/// Two bodies, or a body and a wall, near enough to be looked at. By rank, a < b.
struct PilePair {
  std::uint64_t key = 0;  ///< a and b, sorts by a, then b
  int a = 0;
  Partner b = {};
  int slot = -1;     ///< of its manifold, −1: none
  double until = 0;  ///< [m] nothing can touch while the paths of both add up to less
};

/// Broad phase: each body lives in a fat box, its own enlarged by a part of its size and by its motion over
/// the next frames, and nothing is done while it stays inside. Who leaves is given a new one, and its
/// partners are searched for in a tree of boxes (median splits along the longest side, O(n log n); refitted,
/// and built anew only now and then).
///
/// The pairs are in the order of their keys, whatever happened before.
class PilePairs {
 public:
  PilePairs(std::span<const PileBody> bodies, std::span<const Wall> walls);

  /// Makes sure that all that can touch within `time` [s] at present velocities are among the pairs. With
  /// `lookAhead` [s] ≥ time for those that get a new box.
  void update(std::span<const PileBody> bodies, const Vec3& gravity, double time, double lookAhead);

  std::vector<PilePair>& pairs() { return pairs_; }
  const std::vector<PilePair>& pairs() const { return pairs_; }
  /// Slots of pairs that are no more; the caller takes them.
  std::vector<int>& freed() { return freed_; }

 private:
  struct Box {
    Vec3 low = Vec3::Zero();
    Vec3 high = Vec3::Zero();
    bool overlaps(const Box& other) const;
    bool holds(const Box& other) const;
    void include(const Box& other);
  };
  struct Node {
    Box box;
    int first = 0;  // of its bodies in order_
    int count = 0;
    int right = 0;  // child; the left one is the next node; 0: leaf
  };
  static Box sweptBox(const PileBody& body, const Vec3& gravity, double time);
  void buildTree();
  int buildNode(int first, int count);
  void refit();
  void findPartners(std::span<const PileBody> bodies, std::span<const Wall> walls, int body);
  void merge();

  std::vector<Wall> walls_;
  std::vector<Box> fat_;
  std::vector<char> left_;  // bodies that have just left their boxes
  std::vector<PilePair> pairs_;
  std::vector<PilePair> merged_;
  std::vector<std::uint64_t> found_;
  std::vector<int> freed_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
  int refits_ = 0;
};

}  // namespace careen
