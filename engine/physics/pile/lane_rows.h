#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/math/lanes.h"
#include "core/system/team.h"
#include "physics/pile/block_groups.h"
#include "physics/pile/index.h"
#include "physics/pile/row_list.h"
#include "physics/pile/solver_body.h"
#include "physics/solver/residual_sum.h"
#include "physics/world/contact_residuals.h"

namespace careen {

/// One of the two bodies of four blocks.
struct LaneSide {
  Lanes inverseMass{};
  LanesSymmetric inertia{};
  Lanes radius{};
  Lanes change{};
};
/// The blocks of a group.
struct LaneBlock {
  LaneSide a, b;
  Lanes friction{};
  LanesVec normal{}, tangent1{}, tangent2{}, apart{};
};
struct LaneRow {
  LanesVec arm{};
  Lanes bound{};
  Lanes relaxedMass{};                           ///< normal
  Lanes normalToTangent1{}, normalToTangent2{};  ///< Δu_t per normal impulse
  Lanes stop11{}, stop12{}, stop22{};            ///< (2×2 matrix)⁻¹
  Lanes slide{};                                 ///< 1/largest eigenvalue of the 2×2 matrix
  Lanes normalImpulse{}, tangential1{}, tangential2{};
};
/// What shifts ask of a row [m], and do at it.
struct LaneShift {
  Lanes bound{}, impulse{};
};

/// The rows of a list in lanes, four blocks of a group side by side. Lanes without a row have masses of 0.
class LaneRows {
 public:
  LaneRows(std::shared_ptr<Team> team, Registers registers)
      : team_(team), registers_(registers), groups_(std::move(team)) {}

  void fill(const RowList& list, std::span<const SolverBody> bodies);

  BlockGroups& groups() { return groups_; }
  const BlockGroups& groups() const { return groups_; }
  std::span<const LaneBlock> blocks() const { return blocks_; }  ///< by group
  std::span<LaneRow> rows() { return rows_; }
  std::span<LaneShift> shifts() { return shifts_; }  ///< by index of the row
  Registers registers() const { return registers_; }

  /// Where a row of the list is.
  LaneRow& of(int row) { return rows_[indexOf(row)]; }
  const LaneRow& of(int row) const { return rows_[indexOf(row)]; }
  LaneShift& shiftOf(int row) { return shifts_[indexOf(row)]; }
  int laneOf(int row) const { return static_cast<int>(places_[at(row)] % kLanes); }

  /// [J] Of the impulses that the rows begin with, on that motion without them, beyond what bounds allow.
  double workOfImpulses(std::span<const Moving> moving);
  void clearImpulses();
  /// By the impulses that the rows begin with.
  void push(std::span<Moving> moving);

  /// The bound [m] of each shift is −h v_n.
  void beginShifts(double h, std::span<const Moving> moving);
  /// [m] What is left to be done at one row, at the most.
  double mostLacking(std::span<const Moving> shifted) const;

  /// Of the rows as they stand, bounds being targets; S [m/s] is `speed`.
  ContactResiduals residuals(double speed, std::span<const Moving> moving) const;

 private:
  std::size_t indexOf(int row) const { return places_[at(row)] / kLanes; }
  void fillGroup(std::size_t index, const RowList& list, std::span<const SolverBody> bodies);
  void findMasses(std::size_t index);
  void pushGroup(std::size_t index, std::span<Moving> moving) const;
  template <class Work>
  void forRows(std::span<const Moving> moving, std::size_t first, std::size_t last, const Work& work) const;
  void addResiduals(std::span<const Moving> moving, std::size_t first, std::size_t last,
                    ResidualSum& sum) const;

  std::shared_ptr<Team> team_;
  Registers registers_;
  BlockGroups groups_;
  std::vector<LaneBlock> blocks_;  // by group
  std::vector<LaneRow> rows_;
  std::vector<LaneShift> shifts_;
  std::vector<std::size_t> places_;  // by row of the list: kLanes × index in rows_ + lane
};

}  // namespace careen
