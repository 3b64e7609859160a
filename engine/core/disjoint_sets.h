#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace careen {

/// Which of n things belong together, as pairs are joined (union–find with path halving). A set goes by its
/// least member, in whatever order its pairs were joined.
class DisjointSets {
 public:
  DisjointSets() = default;
  explicit DisjointSets(std::size_t count) { reset(count); }

  /// Each alone.
  void reset(std::size_t count) {
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  void join(std::size_t a, std::size_t b) {
    const std::size_t rootA = root(a);
    const std::size_t rootB = root(b);
    parent_[std::max(rootA, rootB)] = std::min(rootA, rootB);
  }
  /// The least member of its set.
  std::size_t root(std::size_t member) {
    while (parent_[member] != member) {
      parent_[member] = parent_[parent_[member]];
      member = parent_[member];
    }
    return member;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace careen
