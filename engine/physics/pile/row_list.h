#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/geometry/contact_frame.h"
#include "physics/pile/index.h"

namespace careen {

/// An impulse at a contact point, as it begins.
struct PileRow {
  Vec3 arm = Vec3::Zero();  ///< [m] from a's centre
  double bound = 0;         ///< [m/s] lower bound of v_n
  double normalImpulse = 0;
  double tangential1 = 0;
  double tangential2 = 0;
};

/// The rows of a manifold with one frame.
struct RowBlock {
  int a = 0;
  int b = 0;
  int first = 0;  ///< of its rows
  int count = 0;
  double friction = 0;
  ContactFrame frame = {};
  Vec3 apart = Vec3::Zero();  ///< [m] from b's centre to a's
};

/// Rows as they come in: one after the other, or each by its index.
class RowList {
 public:
  void clear();
  /// Rows of that block follow with add().
  void begin(RowBlock block);
  void add(const PileRow& row);

  /// Or, in any order and by several threads at once: first the number of all, then every one by its index,
  /// rows that follow each other in one block.
  struct Extent {
    int blocks = 0;
    int rows = 0;
    int belts = 0;  ///< bodies that PileSolver has for them
  };
  void reserve(Extent all);
  void setBlock(int index, const RowBlock& block);
  void setRow(int index, const PileRow& row) { rows_[at(index)] = row; }

  std::span<const RowBlock> blocks() const { return blocks_; }
  std::span<const PileRow> rows() const { return rows_; }
  int blockOf(int row) const { return blockOfRow_[at(row)]; }

 private:
  std::vector<RowBlock> blocks_;
  std::vector<PileRow> rows_;
  std::vector<int> blockOfRow_;
};

}  // namespace careen
