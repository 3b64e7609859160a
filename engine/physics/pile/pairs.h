#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/math/linear_algebra.h"
#include "core/system/team.h"
#include "physics/pile/body.h"

namespace careen {

/// Broad-phase pair: a box of each of two bodies close enough for the narrow phase, by place, a < b; or of a
/// body a and a half-space b.
struct PilePair {
  std::uint64_t key = 0;  ///< sorts by a, then b, half-spaces last, then their boxes
  int a = 0;
  int b = 0;
  int boxA = 0;   ///< which of a's boxes
  int boxB = 0;   ///< likewise of b's
  int slot = -1;  ///< index of its manifold, −1: none
  // Where there was no manifold when the two were last looked at:
  Vec3 apart = Vec3::Zero();  ///< [m] a's centre from b's
  double turned = 0;          ///< [m] the turned paths of both, together
  double until = 0;           ///< [m] their paths, together, up to which they have none in any case
  double clear = 0;           ///< [m] that they must come nearer for contact points; 0: look again
};

/// Broad phase: each body has a fat AABB, its own enlarged by a fraction of its size and by its motion over
/// the next frames; nothing is done while the body stays inside. A body that leaves it gets a new one, and
/// its partners are queried from a bounding volume tree (median splits along the longest side, O(n log n);
/// refitted, and rebuilt only now and then).
///
/// Pairs are sorted by key, independent of history.
class PilePairs {
 public:
  /// Whether two bodies, by index, stop each other; nothing: all do.
  using MayTouch = std::function<bool(int a, int b)>;
  explicit PilePairs(std::shared_ptr<Team> team = std::make_shared<Team>(1), MayTouch mayTouch = {})
      : team_(std::move(team)), mayTouch_(std::move(mayTouch)) {}

  /// Removes all pairs of a body that is to be replaced by another.
  void clearPlace(int body);

  /// Ensures that all pairs that can touch within `time` [s] at current velocities are listed. New fat AABBs
  /// are sized for `lookAhead` [s] ≥ time. Half-spaces come first, and bodies are only added, at the end.
  void update(std::span<const PileBody> bodies, const Vec3& gravity, double time, double lookAhead);

  std::vector<PilePair>& pairs() { return pairs_; }
  const std::vector<PilePair>& pairs() const { return pairs_; }
  /// Manifold slots of removed pairs; the caller takes them.
  std::vector<int>& freed() { return freed_; }

 private:
  struct Box {
    Vec3 low = Vec3::Zero();
    Vec3 high = Vec3::Zero();
    bool overlaps(const Box& other) const;
    bool holds(const Box& other) const;
    void include(const Box& other);
  };
  static const Box kNowhere;
  struct Node {
    Box box;
    int first = 0;  // index of its first body in order_
    int count = 0;
    int right = 0;  // right child; the left one is the next node; 0: leaf
  };
  static Box sweptBox(const PileBody& body, const Vec3& gravity, double time);
  void buildTree();
  int buildNode(int first, int count);
  void refit();
  bool findLeft(std::span<const PileBody> bodies, const Vec3& gravity, double time, double lookAhead);
  void findPartners(std::span<const PileBody> bodies, int body);
  void addFound(const PileBody& a, int placeA, const PileBody& b, int placeB);
  void merge();

  std::shared_ptr<Team> team_;
  MayTouch mayTouch_;
  std::vector<Box> fat_;
  std::vector<char> left_;  // bodies that have just left their fat AABBs
  std::vector<PilePair> pairs_;
  std::vector<PilePair> merged_;
  std::vector<std::uint64_t> found_;
  std::vector<int> freed_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
  int refits_ = 0;
};

}  // namespace careen
