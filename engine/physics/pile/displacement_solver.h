#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/pile/body.h"
#include "physics/pile/lanes.h"

namespace careen {

/// The smallest mass-weighted displacement of bodies that opens gaps: minimises ½ δᵀM δ + Σ m e²/2c over
/// displacements and turns δ, where e is what a row of J δ lacks of its bound, m its effective mass, and c is
/// small. Where rows contradict each other, as those of a chain of boxes that is longer than the space
/// between its walls, what they lack is shared, and no body goes far for little.
///
/// Solved in the impulses λ ≥ 0 of the rows, each scaled to an effective mass of one, by Nesterov's
/// accelerated projected gradients, begun anew where they lead away: for long chains of bodies, through which
/// Gauss–Seidel carries one link in a sweep.
///
/// Sources: Y. Nesterov, Soviet Math. Dokl. 27, 1983; B. O'Donoghue & E. Candès, Found. Comput. Math. 15,
/// 2015.
class DisplacementSolver {
 public:
  static constexpr double kCompliance = 1e-3;  ///< [1] c

  /// Of these, which must outlive it, until the next begin().
  void begin(std::span<const PileBody> bodies);

  /// A row n·δ ≥ bound [m] at the point with that arm [m] from the centre of body a, relative to the point
  /// with that of b. A body that is kNobody, or still, does not move.
  static constexpr int kNobody = -1;
  struct Row {
    int a = kNobody;
    int b = kNobody;
    Vec3 armA = Vec3::Zero();
    Vec3 armB = Vec3::Zero();
    Vec3 normal = Vec3::UnitZ();  ///< [1] from b to a
    double bound = 0;
  };
  void add(const Row& row);

  /// Until no row lacks more than `enough` [m], or more steps gain little; at most so many. Returns how many.
  int solve(double enough, int most);

  bool moves(int body) const { return !moveOf(body).shift.isZero(0) || !moveOf(body).turn.isZero(0); }
  const Vec3& displacement(int body) const { return moveOf(body).shift; }  ///< [m]
  const Vec3& turn(int body) const { return moveOf(body).turn; }           ///< [rad]

 private:
  struct Member {
    double inverseMass = 0;
    Mat3 inverseInertia = Mat3::Zero();  // world
  };
  struct Move {
    Vec3 shift = Vec3::Zero();
    Vec3 turn = Vec3::Zero();
  };
  struct Block {  // rows that follow each other
    int a = 0;    // in own_
    int b = 0;
    Vec3 normal = Vec3::UnitZ();
    std::size_t end = 0;  // of its rows
  };
  struct ScaledRow {
    Vec3 armA = Vec3::Zero();
    Vec3 armB = Vec3::Zero();
    double scale = 0;  // √(effective mass)
  };
  /// By row, and zeros up to a multiple of kLanes.
  using Values = std::vector<double>;
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const Move& moveOf(int body) const { return moves_[at(members_[at(body)])]; }
  int memberOf(int body);
  int solveInLanes(double enough, int most);
  void apply(const Values& impulses, Values& result);
  double largestEigenvalue();

  std::span<const PileBody> bodies_;
  std::vector<int> members_;  // by body: in own_; 0 for those that do not move
  std::vector<Member> own_;   // after the first
  std::vector<Block> blocks_;
  std::vector<ScaledRow> rows_;
  std::vector<Move> moves_;  // by member, of what apply() was last called with
  Values bounds_, perScale_, impulses_, ahead_, next_;
};

}  // namespace careen
