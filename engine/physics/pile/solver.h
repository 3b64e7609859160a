#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/math/linear_algebra.h"
#include "core/system/rounds.h"
#include "core/system/team.h"
#include "physics/pile/body.h"
#include "physics/pile/lanes.h"
#include "physics/pile/manifold.h"
#include "physics/solver/residual_sum.h"
#include "physics/world/contact_residuals.h"

namespace careen {

/// Projected Gauss–Seidel with a worklist for the contacts of a pile. Unknowns are the velocities of all
/// bodies (in a projection, their displacements); each row is an impulse at a contact point.
///
/// A block, the rows of a manifold with one normal, is solved again only when one of its bodies has changed
/// by more than a tolerance since they were last put on the list; forward, sweep after sweep. Four blocks
/// that share no moving body are solved side by side, which gives what one after the other would. The order
/// is that of insertion but for what this grouping moves, so a shock travels far in one sweep, and quiet
/// contacts cost nothing.
///
/// Normal: v_n ≥ bound, impulse ≥ 0, complementary, with over-relaxation (each impulse changes by more than
/// its row alone asks for; the fixed point is the same). Friction: the tangential impulse lies in the disc of
/// radius μ × normal impulse (round friction cone). First the impulse that stops sliding is tried, by the
/// point's 2×2 matrix; if it leaves the disc, a step along the sliding velocity is projected back onto the
/// disc: its fixed point slides against its impulse, as Coulomb friction requires, while that of the matrix
/// step does not.
///
/// What a step would leave of penetration at the velocities found is undone by shifts: displacements δ of the
/// bodies, with n·δ ≥ bound at the same rows, which never become velocity (split impulses).
///
/// Many blocks are divided into parts, which different threads can solve: slabs across the longest extent,
/// with as many ends of blocks each, and then the blocks between neighbouring slabs, those of every second
/// pair first. How many slabs there are depends on the number of blocks only, so the bits do not depend on
/// the threads.
class PileSolver {
 public:
  explicit PileSolver(std::shared_ptr<Team> team = std::make_shared<Team>(1)) : team_(std::move(team)) {}

  /// How rows come in: one after the other by add(), or each by its index, after reserve().
  enum class Rows : std::uint8_t { kAdded, kSet };
  /// Clears it for that many bodies; one more represents all walls.
  void begin(std::size_t bodies, Rows rows = Rows::kAdded);

  /// Sets a body's inverse mass and inertia; `change` [m/s] is the change that puts its manifolds back on the
  /// list.
  void setBody(int index, const PileBody& body, double change);

  Vec3& velocity(int body) { return moving_[at(body)].velocity; }
  Vec3& omega(int body) { return moving_[at(body)].omega; }
  const Vec3& velocity(int body) const { return moving_[at(body)].velocity; }
  const Vec3& omega(int body) const { return moving_[at(body)].omega; }
  int indexOf(Partner partner) const { return partner.isWall() ? static_cast<int>(bodies_) : partner.body(); }
  /// An impulse [N s] from outside, at that arm [m].
  void push(int body, const Vec3& arm, const Vec3& impulse) {
    moving_[at(body)].velocity += inertia_[at(body)].inverseMass * impulse;
    moving_[at(body)].omega += inertia_[at(body)].times(arm.cross(impulse));
  }
  /// Whether any impulse acted on it since begin().
  bool pushed(int body) const { return moving_[at(body)].pushed != 0; }

  /// Rows of a manifold with one frame follow with add(); `apart` [m] is from b's centre to a's.
  void beginBlock(int a, Partner b, double friction, const ContactFrame& frame, const Vec3& apart);
  struct Row {
    Vec3 arm = Vec3::Zero();  ///< [m] from a's centre
    double bound = 0;         ///< [m/s] lower bound of v_n
    double normalImpulse = 0;
    double tangential1 = 0;
    double tangential2 = 0;
  };
  void add(const Row& row) {
    staged_.push_back(row);
    ++blocks_.back().count;
  }
  /// Or, in any order and by several threads at once: first the number of all, then every one by its index,
  /// rows that follow each other in one block.
  struct Extent {
    int blocks = 0;
    int rows = 0;
  };
  void reserve(Extent all);
  void setBlock(Extent index, int count, int a, Partner b, double friction, const ContactFrame& frame,
                const Vec3& apart);
  void setRow(int index, const Row& row) { staged_[at(index)] = row; }
  /// After the last add(): groups blocks, and builds the contact graph. solve() starts with what wakeAll() or
  /// wakeRow() put on the worklist.
  void link();
  /// Applies the initial impulses of the rows; none, where they would add energy to a motion that parts of
  /// itself: those of a blow that is over, of which the sweeps would undo too little.
  void warmStart();
  /// After the last add(): at most `sweeps` sweeps. Returns the number of manifold solves.
  std::int64_t solve(int sweeps, bool withFriction);

  /// Of the rows as they stand, bounds being targets; S [m/s] is `speed`.
  ContactResiduals residuals(double speed) const;

  /// Shifts, after solve(): beginShifts() begins the bound [m] of each row with −h v_n, addToShiftBound()
  /// adds the rest; wakeRow() for those that lack something; shift(). `change` [m] of a body's displacement
  /// puts its manifolds back on the list.
  void beginShifts(double h);
  /// Returns the whole: what the row lacks without shifts.
  double addToShiftBound(int row, double more) { return shiftRows_[rowAt(row)].bound[laneOf(row)] += more; }
  std::int64_t shift(int sweeps, double change);
  /// [m] What shifts leave to be done at one row, at the most.
  double mostLacking() const;
  bool isShifted(int body) const { return shifts_[at(body)].pushed != 0; }
  const Vec3& displacement(int body) const { return shifts_[at(body)].velocity; }  ///< [m]
  const Vec3& turn(int body) const { return shifts_[at(body)].omega; }             ///< [rad]
  /// [m/s] v_n of the row as it stands.
  double normalSpeed(int row) const;

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

  std::size_t blockCount() const { return blocks_.size(); }
  std::size_t rowCount() const { return staged_.size(); }
  double normalImpulse(int row) const { return rows_[rowAt(row)].normalImpulse[laneOf(row)]; }
  double tangential1(int row) const { return rows_[rowAt(row)].tangential1[laneOf(row)]; }
  double tangential2(int row) const { return rows_[rowAt(row)].tangential2[laneOf(row)]; }
  void setBound(int row, double bound) { rows_[rowAt(row)].bound[laneOf(row)] = bound; }
  void addToBound(int row, double more) { rows_[rowAt(row)].bound[laneOf(row)] += more; }
  void raiseBound(int row, double least) {
    Lanes& bounds = rows_[rowAt(row)].bound;
    bounds[laneOf(row)] = std::max(bounds[laneOf(row)], least);
  }
  void wakeAll();
  /// May be called by several threads at once.
  void wakeRow(int row);
  /// Whether wide registers are used; the bits are the same.
  void useWideLanes(bool wide) { wide_ = wide && hasWideLanes(); }

 private:
  struct alignas(64) Moving {  // read and written as two rows of four
    Vec3 velocity = Vec3::Zero();
    double unqueuedChange = 0;  // [m/s] change since its manifolds were last put on the list
    Vec3 omega = Vec3::Zero();
    double pushed = 0;  // 1 if it was
    const void* row(std::size_t k) const { return reinterpret_cast<const char*>(this) + k * sizeof(Lanes); }
    void* row(std::size_t k) { return reinterpret_cast<char*>(this) + k * sizeof(Lanes); }
  };
  static_assert(sizeof(Moving) == 2 * sizeof(Lanes));
  struct Inertia {
    double inverseMass = 0;
    double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;  // world I⁻¹
    double radius = 0;
    double change = 0;
    Vec3 times(const Vec3& v) const {
      return {xx * v.x() + xy * v.y() + xz * v.z(), xy * v.x() + yy * v.y() + yz * v.z(),
              xz * v.x() + yz * v.y() + zz * v.z()};
    }
  };
  struct Block {
    int a = 0;
    int b = 0;
    int first = 0;  // row
    int count = 0;
    double friction = 0;
    ContactFrame frame;
    Vec3 apart;
    std::size_t part = 0;
    int place = -1;  // kLanes × group + lane
  };
  /// Blocks no two of which share a body that moves: solved side by side, as if one after the other.
  struct Group {
    std::array<int, kLanes> a{}, b{};  // bodies
    std::array<int, kLanes> counts{};  // rows
    std::array<int, kLanes> blocks{};
    int used = 0;   // lanes
    int first = 0;  // in rows_
    int count = 0;  // of the longest
  };
  struct Side {
    Lanes inverseMass{};
    LanesSymmetric inertia{};
    Lanes radius{};
    Lanes change{};
  };
  struct LaneBlock {
    Side a, b;
    Lanes friction{};
    LanesVec normal{}, tangent1{}, tangent2{}, apart{};
  };
  struct LaneRow {
    LanesVec arm{};
    Lanes bound{};
    Lanes relaxedMass{};                           // normal
    Lanes normalToTangent1{}, normalToTangent2{};  // Δu_t per normal impulse
    Lanes stop11{}, stop12{}, stop22{};            // (2×2 matrix)⁻¹
    Lanes slide{};                                 // 1/largest eigenvalue of the 2×2 matrix
    Lanes normalImpulse{}, tangential1{}, tangential2{};
  };
  struct ShiftRow {
    Lanes bound{}, impulse{};
  };
  struct Velocities {
    LanesVec v, w;
    Lanes unqueuedChange, pushed;
  };
  /// Solved by one thread: of what others write meanwhile it reads nothing.
  struct Part {
    std::size_t first = 0;  // groups
    std::size_t last = 0;
    double work = 0;  // [J] of initial impulses
    int nobody = 0;   // in moving_, in place of bodies that cannot move
    // While groups are found:
    std::span<const int> blocks;
    std::vector<Group> groups;
    std::vector<std::vector<int>> open;  // of these, with lanes left, by number of rows
    int rows = 0;                        // of these, then the first in rows_
  };
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  std::size_t rowAt(int row) const { return rowPlaces_[at(row)] / kLanes; }
  int laneOf(int row) const { return static_cast<int>(rowPlaces_[at(row)] % kLanes); }
  enum class Kind : std::uint8_t { kFriction, kFrictionless, kShift };
  bool movable(int body) const { return inertia_[at(body)].inverseMass > 0; }
  /// work(block, index of the row, velocity) for rows of groups.
  template <class Work>
  void forRows(const std::vector<Moving>& moving, std::size_t first, std::size_t last,
               const Work& work) const;
  void findParts();
  void orderParts();
  void findSlabs(std::size_t count);
  void findGroups();
  void findGroupsOf(Part& part);
  void findGroup(int index, Part& part);
  bool sharesBody(const Group& group, const Block& block) const;
  void fillGroups();
  void fillGroupsOf(Part& part);
  void fillGroup(const Group& group, LaneBlock& lanes);
  void fillSide(Side& side, int lane, int body) const;
  void findMasses(const Group& group, const LaneBlock& lanes);
  double workOfImpulses();
  void addResiduals(std::size_t first, std::size_t last, ResidualSum& sum) const;
  void push(const Group& group, const LaneBlock& block);
  static void put(std::vector<Moving>& moving, const std::array<int, kLanes>& bodies, Velocities velocities);
  /// Work on each part, by several threads, each time the same one if it has time.
  template <class Work>
  void forParts(const Work& work) {
    rounds_.run(*team_, 1, [&](std::size_t part) {
      work(parts_[part]);
      return 0;
    });
  }
  template <Kind kKind>
  std::int64_t sweep(int sweeps);
  template <Kind kKind>
  std::int64_t sweepPart(const Part& part);
  template <Kind kKind>
  void solveGroup(std::size_t index, const LaneMask& asked);
  template <Kind kKind>
  void store(const std::array<int, kLanes>& bodies, const Side& side, const Velocities& from, Velocities to,
             const LaneMask& changed);
  static Velocities velocitiesOf(const std::vector<Moving>& moving, const std::array<int, kLanes>& bodies);
  LaneCounts changesOf(const std::array<int, kLanes>& bodies) const;
  template <class Work>
  void run(const Work& work) const {
    runInLanes(work, wide_);
  }

  std::shared_ptr<Team> team_;
  bool wide_ = hasWideLanes();
  std::size_t bodies_ = 0;
  std::vector<Vec3> places_;        // [m] of the bodies
  std::vector<std::size_t> slabs_;  // by body, of those that can move
  std::vector<Part> parts_;
  Rounds rounds_;
  std::vector<int> ordered_;    // blocks, by part
  std::vector<Moving> moving_;  // by body, then of the walls, then nobody's, for each part
  std::vector<Moving> shifts_;  // displacements and turns in place of velocities
  double shiftChange_ = 0;      // [m]
  std::vector<Inertia> inertia_;
  std::vector<Row> staged_;
  std::vector<Block> blocks_;
  std::vector<Group> groups_;
  std::vector<LaneBlock> lanes_;  // by group
  std::vector<LaneRow> rows_;
  std::vector<ShiftRow> shiftRows_;
  std::vector<int> blockOfRow_;
  std::vector<std::size_t> rowPlaces_;  // kLanes × index in rows_ + lane
  // Per body, how often it changed enough to solve its blocks again; and the sum of those of both bodies when
  // a block was solved last, by place. A block whose sum is another is on the list.
  std::vector<std::uint32_t> changes_;
  std::vector<std::uint32_t> seen_;
};

}  // namespace careen
