#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/math/lanes.h"
#include "core/system/rounds.h"
#include "core/system/team.h"
#include "physics/pile/index.h"
#include "physics/pile/row_list.h"
#include "physics/pile/solver_body.h"

namespace careen {

/// Which blocks of rows are solved side by side: by several threads, and four by each.
///
/// Many blocks are divided into parts, which different threads can solve: slabs across the longest extent,
/// with as many ends of blocks each, and then the blocks between neighbouring slabs, those of every second
/// pair first. How many slabs there are depends on the number of blocks only, so the bits do not depend on
/// the threads.
///
/// Four blocks of a part that share no body that moves are a group: solved side by side, as if one after the
/// other.
class BlockGroups {
 public:
  explicit BlockGroups(std::shared_ptr<Team> team) : team_(std::move(team)) {}

  struct Group {
    LaneBodies a{}, b{};               ///< in place of those that cannot move and are no belts, nobody
    std::array<int, kLanes> counts{};  ///< rows
    std::array<int, kLanes> blocks{};
    int used = 0;   ///< lanes
    int first = 0;  ///< row, of all groups'
    int count = 0;  ///< rows of the longest
  };
  void find(std::span<const RowBlock> blocks, std::span<const SolverBody> bodies);
  /// From now on, parts that share bodies wait for each other.
  void order();

  std::span<const Group> groups() const { return groups_; }
  /// kLanes × group + lane
  int placeOf(int block) const { return placeOf_[at(block)]; }
  /// Of all groups.
  int rowCount() const { return groups_.empty() ? 0 : groups_.back().first + groups_.back().count; }
  std::size_t partCount() const { return parts_.size(); }
  /// The bodies, and for each part one that is nobody: of what others write meanwhile, a part reads nothing.
  std::size_t bodyCount() const { return bodies_.size() + parts_.size(); }

  /// work(part, first group, end), which returns how much it did, at most so many times each, as Rounds do.
  template <class Work>
  std::int64_t sweep(int most, const Work& work) {
    return rounds_.run(*team_, most,
                       [&](std::size_t part) { return work(part, parts_[part].first, parts_[part].last); });
  }
  /// The same once, by several threads, each time the same one if it has time.
  template <class Work>
  void forParts(const Work& work) {
    sweep(1, [&](std::size_t part, std::size_t first, std::size_t last) {
      work(part, first, last);
      return 0;
    });
  }

 private:
  struct Part {
    std::size_t first = 0;  // groups
    std::size_t last = 0;
    // While groups are found:
    std::span<const int> blocks;
    std::vector<Group> groups;
    std::vector<std::vector<int>> open;  // of these, with lanes left, by number of rows
    int rows = 0;                        // of these, then the first of all
  };
  bool moves(int body) const { return bodies_[at(body)].moves(); }
  bool isRead(int body) const { return bodies_[at(body)].moves() || bodies_[at(body)].isBelt; }
  void findParts();
  void findSlabs(std::size_t count);
  void divideBlocks();
  void findGroups(Part& part, int nobody);
  void addToGroup(int index, Part& part, int nobody);
  bool sharesBody(const Group& group, const RowBlock& block) const;
  void placeGroups();

  std::shared_ptr<Team> team_;
  Rounds rounds_;
  std::span<const RowBlock> blocks_;
  std::span<const SolverBody> bodies_;
  std::vector<std::size_t> slabs_;   // by body, of those that can move
  std::vector<std::size_t> partOf_;  // by block
  std::vector<int> ordered_;         // blocks, by part
  std::vector<Part> parts_;
  std::vector<Group> groups_;
  std::vector<int> placeOf_;  // by block
};

}  // namespace careen
