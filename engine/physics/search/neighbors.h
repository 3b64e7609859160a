#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/math/linear_algebra.h"

namespace careen {

/// Cell of the grid, in cell edges from the world's origin.
using Cell = std::array<std::int64_t, 3>;

/// Whom a body can meet, without asking all: a grid of cubic cells, each body filed under the cell of its
/// centre. The edge is 8/7 of the largest diameter, and a body is filed anew when its centre is more than
/// 1/16 of an edge outside its cell; so spheres that touch are always in the same or adjoining cells, a body
/// on a border does not flit, and rounding has 1/16 of an edge to live in. Per event: 27 cells, O(1) for a
/// gas.
///
/// Very unequal sizes: bodies more than 4 times the median radius (a floor, a ramp) are not filed but listed
/// apart, and are candidates of everyone. That costs O(their number) per event, and the cells stay small.
/// With many large bodies among many more small ones this grows to O(large).
///
/// Few bodies have no grid: to ask all of them costs less than to file one.
///
/// Bodies are known by the caller's keys and lists come sorted by key: no answer depends on the order of
/// filing.
class Neighbors {
 public:
  using Key = int;
  static constexpr std::size_t kFew = 8;

  /// Sizes the cells; bodies to come should be about as large as these. No more than kFew: no cells.
  explicit Neighbors(std::span<const double> radii);

  /// [m] 0 if there is no grid.
  double cellEdge() const { return edge_; }
  Cell cellOf(const Vec3& position) const;

  /// Keys must be new. A sphere too large for the cells is listed apart.
  void insert(Key body, const Vec3& position, double radius);
  void erase(Key body);
  void move(Key body, const Cell& cell);
  /// The body's cell as filed; only for bodies with isFiled.
  const Cell& cell(Key body) const { return places_.at(body).cell; }
  bool isFiled(Key body) const { return places_.at(body).filed; }

  /// Everyone the body can touch before it or they are filed anew: sorted, itself left out. Large bodies are
  /// candidates of all and have all as candidates.
  void findCandidates(Key body, std::vector<Key>& candidates) const;

  struct Crossing {
    double time = 0;  ///< [s] from the flight's start; past every time if it stays
    Cell cell{};      ///< to be filed under then
  };
  /// When a centre on the parabola position + velocity·t + ½ acceleration·t² has left `cell` by 1/16 of an
  /// edge, not before `from`. Closed form; later crossings are found by asking again.
  Crossing nextCrossing(const Vec3& position, const Vec3& velocity, const Vec3& acceleration,
                        const Cell& cell, double from) const;

 private:
  struct Place {
    Cell cell{};
    bool filed = false;
  };
  struct CellHash {
    std::size_t operator()(const Cell& cell) const;
  };
  void file(Key body, const Cell& cell);
  void unfile(Key body, const Cell& cell);

  double edge_ = 0;
  double largestFiled_ = 0;
  std::unordered_map<Cell, std::vector<Key>, CellHash> cells_;
  std::unordered_map<Key, Place> places_;
  std::vector<Key> large_;
};

}  // namespace careen
