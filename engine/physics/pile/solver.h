#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/pile/body.h"
#include "physics/pile/manifold.h"
#include "physics/world/contact_residuals.h"

namespace careen {

/// Projected Gauss–Seidel with a worklist for the contacts of a pile. Unknowns are the velocities of all
/// bodies (in a projection, their displacements); each row is an impulse at a contact point.
///
/// A manifold is solved again only when one of its bodies has changed by more than a tolerance since they
/// were last put on the list; in the order of insertion, forward, sweep after sweep. A shock thus travels in
/// one sweep as far as the order leads, and quiet contacts cost nothing.
///
/// Normal: v_n ≥ bound, impulse ≥ 0, complementary. Friction: the tangential impulse lies in the disc of
/// radius μ × normal impulse (round friction cone). First the impulse that stops sliding is tried, by the
/// point's 2×2 matrix; if it leaves the disc, a step along the sliding velocity is projected back onto the
/// disc: its fixed point slides against its impulse, as Coulomb friction requires, while that of the matrix
/// step does not.
///
/// What a step would leave of penetration at the velocities found is undone by shifts: displacements δ of the
/// bodies, with n·δ ≥ bound at the same rows, which never become velocity (split impulses).
class PileSolver {
 public:
  /// Clears it for that many bodies; one more, the last, represents all walls.
  void begin(std::size_t bodies);

  /// Sets a body's inverse mass and inertia; `change` [m/s] is the change that puts its manifolds back on the
  /// list.
  void setBody(int index, const PileBody& body, double change);

  Vec3& velocity(int body) { return moving_[at(body)].velocity; }
  Vec3& omega(int body) { return moving_[at(body)].omega; }
  int indexOf(Partner partner) const {
    return partner.isWall() ? static_cast<int>(moving_.size()) - 1 : partner.body();
  }
  /// An impulse [N s] from outside, at that arm [m].
  void push(int body, const Vec3& arm, const Vec3& impulse) {
    moving_[at(body)].velocity += inertia_[at(body)].inverseMass * impulse;
    moving_[at(body)].omega += inertia_[at(body)].times(arm.cross(impulse));
  }
  /// Whether any impulse acted on it since begin().
  bool pushed(int body) const { return moving_[at(body)].pushed; }

  /// A manifold's rows follow with add(). Manifolds must come in order of their keys.
  void beginManifold(int a, Partner b, double friction);
  struct Row {
    Vec3 armA = Vec3::Zero();  ///< [m]
    Vec3 armB = Vec3::Zero();  ///< [m]
    PileFrame frame;
    double bound = 0;  ///< [m/s] lower bound of v_n
    double normalImpulse = 0;
    double tangential1 = 0;
    double tangential2 = 0;
  };
  void add(const Row& row);
  /// Applies the initial impulses of the rows.
  void warmStart();
  /// After the last add(): at most `sweeps` sweeps. Returns the number of manifold solves.
  std::int64_t solve(int sweeps, bool withFriction);

  /// Of the rows as they stand, bounds being targets; S [m/s] is `speed`.
  ContactResiduals residuals(double speed) const;

  /// Shifts, after solve(): beginShifts(), a bound [m] for each row, wakeRow() for those that are below
  /// theirs, shift(). `change` [m] of a body's displacement puts its manifolds back on the list.
  void beginShifts() { shifts_.assign(moving_.size(), {}); }
  void setShiftBound(int row, double bound) { rows_[at(row)].shiftBound = bound; }
  std::int64_t shift(int sweeps, double change);
  bool isShifted(int body) const { return shifts_[at(body)].pushed; }
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
    std::array<Vec3, 3> directions;  ///< normal, tangent, tangent
    double friction = 0;
    double bound = 0;
    std::array<double, 3> impulse{};
  };
  RowView row(int row) const;
  /// Of a solution found otherwise, whose velocities are set too.
  void setImpulse(int row, const std::array<double, 3>& impulse);

  std::size_t blockCount() const { return blocks_.size(); }
  std::size_t rowCount() const { return rows_.size(); }
  double normalImpulse(int row) const { return rows_[at(row)].normalImpulse; }
  double tangential1(int row) const { return rows_[at(row)].tangential1; }
  double tangential2(int row) const { return rows_[at(row)].tangential2; }
  void setBound(int row, double bound) { rows_[at(row)].bound = bound; }
  /// After the last add(): builds the contact graph. solve() starts with what wakeAll() or wakeRow() put on
  /// the worklist.
  void link();
  void wakeAll();
  void wakeRow(int row);

 private:
  struct Moving {
    Vec3 velocity = Vec3::Zero();
    double unqueuedChange = 0;  // [m/s] change since its manifolds were last put on the list
    Vec3 omega = Vec3::Zero();
    bool pushed = false;
  };
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
  // Two doubles for two bodies at once (SIMD), a's first; bitwise equal to scalar operations.
  using Pair = double __attribute__((vector_size(16)));
  struct PairVec {
    Pair x, y, z;
  };
  static PairVec pairOf(const Vec3& a, const Vec3& b) {
    return {Pair{a.x(), b.x()}, Pair{a.y(), b.y()}, Pair{a.z(), b.z()}};
  }
  static PairVec cross(const PairVec& a, const PairVec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  static Vec3 firstOf(const PairVec& v) { return {v.x[0], v.y[0], v.z[0]}; }
  static Vec3 secondOf(const PairVec& v) { return {v.x[1], v.y[1], v.z[1]}; }
  // Inverse masses and inertia of two bodies.
  struct PairInertia {
    Pair inverseMass, xx, yy, zz, xy, xz, yz;
    PairInertia(const Inertia& a, const Inertia& b)
        : inverseMass{a.inverseMass, b.inverseMass},
          xx{a.xx, b.xx},
          yy{a.yy, b.yy},
          zz{a.zz, b.zz},
          xy{a.xy, b.xy},
          xz{a.xz, b.xz},
          yz{a.yz, b.yz} {}
    PairVec times(const PairVec& v) const {
      return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z};
    }
  };
  struct SolvedRow {
    PairVec arms;
    Vec3 normal, tangent1, tangent2;
    double bound = 0;
    double massNormal = 0;
    double normalToTangent1 = 0, normalToTangent2 = 0;  // Δu_t per normal impulse
    double stop11 = 0, stop12 = 0, stop22 = 0;          // (2×2 matrix)⁻¹
    double slide = 0;                                   // 1/largest eigenvalue of the 2×2 matrix
    double normalImpulse = 0, tangential1 = 0, tangential2 = 0;
    double shiftBound = 0, shiftImpulse = 0;
  };
  struct Block {
    int a = 0;
    int b = 0;
    int first = 0;
    int count = 0;
    double friction = 0;
  };
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  enum class Kind : std::uint8_t { kFriction, kFrictionless, kShift };
  template <class Solve>
  std::int64_t sweep(int sweeps, const Solve& solve);
  template <Kind kKind>
  void solveBlock(const Block& block);
  template <Kind kKind>
  void store(int body, const Vec3& velocity, const Vec3& omega);
  void queueBlocksOf(int body);
  void put(std::size_t block) { waiting_[block / 64] |= std::uint64_t{1} << (block % 64); }

  std::vector<Moving> moving_;
  std::vector<Moving> shifts_;  // displacements and turns in place of velocities
  double shiftChange_ = 0;      // [m]
  std::vector<Inertia> inertia_;
  std::vector<SolvedRow> rows_;
  std::vector<Block> blocks_;
  std::vector<int> blockOfRow_;
  std::vector<int> firstBlock_;  // per body, index into blocksOfBody_
  std::vector<int> blocksOfBody_;
  std::vector<int> cursor_;
  std::vector<std::uint64_t> waiting_;
};

}  // namespace careen
