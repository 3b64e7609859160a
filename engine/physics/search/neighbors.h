#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/motion/motion.h"

namespace careen {

/// Grid cell: integer coordinates in cell edges from the world's origin.
using Cell = std::array<std::int64_t, 3>;

/// Broad phase: a uniform grid of cubic cells, each body stored in the cell of its centre. The edge is 8/7 of
/// the largest diameter, and a body changes cell when its centre is more than 1/16 of an edge outside its
/// cell; so touching spheres are always in the same or adjacent cells, a body on a border does not switch
/// back and forth, and 1/16 of an edge absorbs rounding. Per event: 27 cells, O(1) for a gas.
///
/// Very unequal sizes: bodies more than 4 times the median radius (a floor, a ramp) are not stored in the
/// grid but in a separate list, and are candidates of every body. That costs O(their number) per event, and
/// the cells stay small. With many large bodies among many more small ones this grows to O(large).
///
/// Few bodies have no grid: testing all costs less than maintaining cells.
///
/// Bodies are identified by the caller's keys and lists are sorted by key: no result depends on insertion
/// order.
class Neighbors {
 public:
  using Key = int;
  static constexpr std::size_t kFew = 8;

  /// Chooses the cell size from typical radii. No grid for kFew or fewer.
  explicit Neighbors(std::span<const double> radii);

  /// [m] 0 if there is no grid.
  double cellEdge() const { return edge_; }
  Cell cellOf(const Vec3& position) const;

  /// Keys must be new. A sphere too large for the cells goes to the separate list.
  void insert(Key body, const Vec3& position, double radius);
  void erase(Key body);
  void move(Key body, const Cell& cell);
  /// The cell in which the body is stored; only for bodies with isFiled.
  const Cell& cell(Key body) const { return places_.at(body).cell; }
  bool isFiled(Key body) const { return places_.at(body).filed; }

  /// All bodies it can touch before either changes cell: sorted, itself excluded. Large bodies are candidates
  /// of all and have all as candidates.
  void findCandidates(Key body, std::vector<Key>& candidates) const;
  /// Whether does(key) is true of any of them; asked in no order, and not of those after the first.
  template <class Does>
  bool anyCandidate(Key body, const Does& does) const {
    const auto asks = [&](Key other) { return other != body && does(other); };
    const Place& place = places_.at(body);
    return place.filed ? std::any_of(large_.begin(), large_.end(), asks) ||
                             anyAround(place.cell,
                                       [&](const std::vector<Key>& filed) {
                                         return std::any_of(filed.begin(), filed.end(), asks);
                                       })
                       : std::any_of(places_.begin(), places_.end(),
                                     [&](const auto& each) { return asks(each.first); });
  }

  /// All bodies whose spheres may reach into that box [m], none if it is empty: sorted. Costs as many cells
  /// as lie in it, or all bodies if these are fewer.
  void findWithin(const Vec3& low, const Vec3& high, std::vector<Key>& found) const;

  struct Crossing {
    double time = 0;  ///< [s] from the flight's start; later than any time if it stays
    Cell cell{};      ///< new cell from then on
  };
  /// When a centre on the parabola position + velocity·t + ½ acceleration·t² is 1/16 of an edge outside
  /// `cell`, not before `from`. Closed form; call again for later crossings.
  Crossing nextCrossing(const Vec3& position, const Vec3& velocity, const Vec3& acceleration,
                        const Cell& cell, double from) const;
  /// Of a flight whose acceleration may grow until it has lasted so long [s]: later than that if it stays.
  /// With jerk it is 3/64 to 1/16 of an edge outside.
  Crossing nextCrossing(const Flight& flight, double lasts, const Cell& cell, double from) const;
  /// When a centre on `step`, not faster than `speedBound` [m/s], is 3/64 to 1/16 of an edge outside `cell`,
  /// not before `from`: later than the step if it stays.
  Crossing nextCrossing(const ContactStep& step, double speedBound, const Cell& cell, double from) const;

 private:
  struct Place {
    Cell cell{};
    bool filed = false;
  };
  struct CellHash {
    std::size_t operator()(const Cell& cell) const;
  };
  /// Whether does(keys) is true of those in a cell or one beside it.
  template <class Does>
  bool anyAround(const Cell& cell, const Does& does) const {
    for (std::int64_t x = -1; x <= 1; ++x) {
      for (std::int64_t y = -1; y <= 1; ++y) {
        for (std::int64_t z = -1; z <= 1; ++z) {
          const auto found = cells_.find({cell[0] + x, cell[1] + y, cell[2] + z});
          if (found != cells_.end() && does(found->second)) {
            return true;
          }
        }
      }
    }
    return false;
  }
  /// [m] from `position` to what is 1/16 of an edge outside `cell`; negative beyond.
  double room(const Vec3& position, const Cell& cell) const;
  void file(Key body, const Cell& cell);
  void unfile(Key body, const Cell& cell);

  double edge_ = 0;
  double largestFiled_ = 0;
  std::unordered_map<Cell, std::vector<Key>, CellHash> cells_;
  std::unordered_map<Key, Place> places_;
  std::vector<Key> large_;
};

}  // namespace careen
