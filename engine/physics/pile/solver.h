#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/math/lanes.h"
#include "core/math/linear_algebra.h"
#include "core/system/team.h"
#include "physics/pile/body.h"
#include "physics/pile/index.h"
#include "physics/pile/lane_rows.h"
#include "physics/pile/lane_sweep.h"
#include "physics/pile/manifold.h"
#include "physics/pile/row_list.h"
#include "physics/pile/solver_body.h"
#include "physics/world/contact_residuals.h"

namespace careen {

/// The contacts of a pile: unknowns are the velocities of all bodies (in a projection, their displacements);
/// each row is an impulse at a contact point. Rows come in blocks, those of a manifold with one normal
/// (RowList); blocks are divided among threads and lanes (BlockGroups, LaneRows), and solved sweep after
/// sweep (LaneSweep).
///
/// What a step would leave of penetration at the velocities found is undone by shifts: displacements δ of the
/// bodies, with n·δ ≥ bound at the same rows, which never become velocity (split impulses).
class PileSolver {
 public:
  explicit PileSolver(std::shared_ptr<Team> team = std::make_shared<Team>(1),
                      Registers registers = widestRegisters())
      : rows_(std::move(team), registers) {}

  /// How rows come in: one after the other by add(), or each by its index, after reserve().
  enum class Rows : std::uint8_t { kAdded, kSet };
  /// Clears it for that many bodies.
  void begin(std::size_t bodies, Rows rows = Rows::kAdded);

  /// Sets a body's inverse mass and inertia; `change` [m/s] is the change that puts its manifolds back on the
  /// list.
  void setBody(int index, const PileBody& body, double change) {
    bodies_[at(index)] = solverBody(body, change);
  }

  Vec3& velocity(int body) { return moving_[at(body)].velocity; }
  Vec3& omega(int body) { return moving_[at(body)].omega; }
  const Vec3& velocity(int body) const { return moving_[at(body)].velocity; }
  const Vec3& omega(int body) const { return moving_[at(body)].omega; }
  /// An impulse [N s] from outside, at that arm [m].
  void push(int body, const Vec3& arm, const Vec3& impulse) {
    moving_[at(body)].velocity += bodies_[at(body)].inverseMass * impulse;
    moving_[at(body)].omega += bodies_[at(body)].turned(arm.cross(impulse));
  }
  /// An impulse [N s] and its moment [N m s] about the centre: it is pushed.
  void give(int body, const Vec3& impulse, const Vec3& moment) {
    setPushed(body, velocity(body) + bodies_[at(body)].inverseMass * impulse,
              omega(body) + bodies_[at(body)].turned(moment));
  }
  /// Whether any impulse acted on it since begin().
  bool pushed(int body) const { return moving_[at(body)].pushed != 0; }

  /// Rows of a manifold with one frame follow with add(); `apart` [m] is from b's centre to a's.
  void beginBlock(int a, int b, double friction, const ContactFrame& frame, const Vec3& apart) {
    list_.begin({.a = a, .b = b, .friction = friction, .frame = frame, .apart = apart});
  }
  using Row = PileRow;
  void add(const Row& row) { list_.add(row); }
  /// Or as RowList::reserve() says.
  using Extent = RowList::Extent;
  void reserve(Extent all);
  /// A body that cannot be moved, for one block; its index. And those of reserve(), by theirs.
  int addBelt(const Moving& motion);
  int setBelt(int belt, const Moving& motion);
  void setBlock(Extent index, int count, int a, int b, double friction, const ContactFrame& frame,
                const Vec3& apart);
  void setRow(int index, const Row& row) { list_.setRow(index, row); }
  /// After the last add(): groups blocks, and builds the contact graph. solve() starts with what wakeAll() or
  /// wakeRow() put on the worklist.
  void link();
  /// Applies the initial impulses of the rows; none, where they would add energy to a motion that parts of
  /// itself: those of a blow that is over, of which the sweeps would undo too little.
  void warmStart();
  enum class Friction { kNone, kCoulomb };
  /// After the last add(): at most `sweeps` sweeps. Returns the number of manifold solves.
  std::int64_t solve(int sweeps, Friction friction = Friction::kCoulomb);

  /// Of the rows as they stand, bounds being targets; S [m/s] is `speed`.
  ContactResiduals residuals(double speed) const { return rows_.residuals(speed, moving_); }

  /// Shifts, after solve(): beginShifts() begins the bound [m] of each row with −h v_n, addToShiftBound()
  /// adds the rest; wakeRow() for those that lack something; shift(). `change` [m] of a body's displacement
  /// puts its manifolds back on the list.
  void beginShifts(double h);
  /// Returns the whole: what the row lacks without shifts.
  double addToShiftBound(int row, double more) { return rows_.shiftOf(row).bound[rows_.laneOf(row)] += more; }
  std::int64_t shift(int sweeps, double change) {
    return sweep_.run(LaneSweep::Kind::kShift, sweeps, rows_, shifts_, change);
  }
  /// [m] What shifts leave to be done at one row, at the most.
  double mostLacking() const { return rows_.mostLacking(shifts_); }
  bool isShifted(int body) const { return shifts_[at(body)].pushed != 0; }
  const Vec3& displacement(int body) const { return shifts_[at(body)].velocity; }  ///< [m]
  const Vec3& turn(int body) const { return shifts_[at(body)].omega; }             ///< [rad]
  /// One row as it stands.
  struct RowView {
    int a = 0;  ///< as in velocity()
    int b = 0;
    Vec3 armA;
    Vec3 armB;
    std::array<Vec3, 3> axes;  ///< normal, tangent, tangent
    double friction = 0;
    double bound = 0;
    std::array<double, 3> impulse{};
  };
  RowView row(int row) const;
  /// Of a solution found otherwise, whose velocities are set too.
  void setImpulse(int row, const std::array<double, 3>& impulse);

  /// Of one that pushes it, too, where there are no impulses.
  void setPushed(int body, const Vec3& velocity, const Vec3& omega) {
    moving_[at(body)] = {.velocity = velocity, .omega = omega, .pushed = 1};
  }

  std::size_t blockCount() const { return list_.blocks().size(); }
  std::size_t rowCount() const { return list_.rows().size(); }
  double normalImpulse(int row) const { return rows_.of(row).normalImpulse[rows_.laneOf(row)]; }
  double tangential1(int row) const { return rows_.of(row).tangential1[rows_.laneOf(row)]; }
  double tangential2(int row) const { return rows_.of(row).tangential2[rows_.laneOf(row)]; }
  void setBound(int row, double bound) { rows_.of(row).bound[rows_.laneOf(row)] = bound; }
  /// That much more, but no less than `least`.
  void addToBound(int row, double more, double least) {
    Lanes& bounds = rows_.of(row).bound;
    bounds[rows_.laneOf(row)] = std::max(bounds[rows_.laneOf(row)] + more, least);
  }
  void wakeAll();
  /// May be called by several threads at once.
  void wakeRow(int row) { sweep_.wake(rows_.groups().placeOf(list_.blockOf(row))); }

 private:
  std::vector<SolverBody> bodies_;
  std::vector<Moving> moving_;  // by body, belts among them, then nobody's
  std::vector<Moving> shifts_;  // displacements and turns in place of velocities
  RowList list_;
  LaneRows rows_;
  LaneSweep sweep_;
  int firstBelt_ = 0;  // of reserve()
};

}  // namespace careen
