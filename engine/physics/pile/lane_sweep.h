#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/lanes.h"
#include "physics/pile/block_groups.h"
#include "physics/pile/index.h"
#include "physics/pile/lane_rows.h"
#include "physics/pile/solver_body.h"

namespace careen {

/// Projected Gauss–Seidel sweeps over rows in lanes, with a worklist.
///
/// A block is solved again only when one of its bodies has changed by more than a tolerance since they were
/// last put on the list; forward, sweep after sweep. The order is that of insertion but for what the grouping
/// moves, so a shock travels far in one sweep, and quiet contacts cost nothing.
///
/// Normal: v_n ≥ bound, impulse ≥ 0, complementary, with over-relaxation (each impulse changes by more than
/// its row alone asks for; the fixed point is the same). Friction: the tangential impulse lies in the disc of
/// radius μ × normal impulse (round friction cone). First the impulse that stops sliding is tried, by the
/// point's 2×2 matrix; if it leaves the disc, a step along the sliding velocity is projected back onto the
/// disc: its fixed point slides against its impulse, as Coulomb friction requires, while that of the matrix
/// step does not.
class LaneSweep {
 public:
  /// Nothing is on the worklist.
  void begin(const BlockGroups& groups);
  /// Puts the block at that place on it. May be called by several threads at once.
  void wake(int place) { std::atomic_ref(seen_[at(place)]).store(kNeverSeen, std::memory_order_relaxed); }

  enum class Kind : std::uint8_t { kFriction, kFrictionless, kShift };
  /// At most that many sweeps. `change` [m] of a displacement puts the blocks of a body that shifts back on
  /// the list. Returns the number of blocks solved.
  std::int64_t run(Kind kind, int most, LaneRows& rows, std::span<Moving> moving, double change = 0);

 private:
  static constexpr std::uint32_t kNeverSeen = 0xffffffff;
  struct Swept {
    std::span<const BlockGroups::Group> groups;
    std::span<const LaneBlock> blocks;
    std::span<LaneRow> rows;
    std::span<LaneShift> shifts;
    std::span<Moving> moving;
    double change = 0;
  };
  template <Kind kKind>
  std::int64_t runKind(int most, LaneRows& rows, const Swept& swept);
  template <Kind kKind>
  std::int64_t sweepGroups(const Swept& swept, std::size_t first, std::size_t last);
  template <Kind kKind>
  void solveGroup(const Swept& swept, std::size_t index, const LaneMask& asked);
  template <Kind kKind>
  void store(const Swept& swept, const LaneBodies& bodies, const LaneSide& side, const MovingLanes& from,
             MovingLanes to, const LaneMask& changed);
  LaneCounts changesOf(const LaneBodies& bodies) const;

  // Per body, how often it changed enough to solve its blocks again; and the sum of those of both bodies when
  // a block was solved last, by place. A block whose sum is another is on the list.
  std::vector<std::uint32_t> changes_;
  std::vector<std::uint32_t> seen_;
};

}  // namespace careen
