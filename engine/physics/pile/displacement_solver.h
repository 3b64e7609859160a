#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/pile/body.h"

namespace careen {

/// The smallest mass-weighted displacement of bodies that opens gaps: minimises ½ δᵀM δ + Σ m e²/2c over
/// displacements and turns δ, where e is what a row of J δ lacks of its bound, m its effective mass, and c is
/// small. Where rows contradict each other, as those of a chain of boxes that is longer than the space
/// between its walls, what they lack is shared, and no body goes far for little.
///
/// Solved in the impulses λ ≥ 0 of the rows, each scaled to an effective mass of one, by conjugate gradients
/// in the face of those that push, which is left and entered by steps along the gradient (MPRGP): for long
/// chains of bodies, through which Gauss–Seidel carries one link in a sweep.
///
/// Source: Z. Dostál, Optimal Quadratic Programming Algorithms, 2009, section 5.8.
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

  bool moves(int body) const { return members_[at(body)] != kNobody && !isZero(moveOf(body)); }
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
  struct ScaledRow {
    int a = kNobody;  // in own_
    int b = kNobody;
    Move onA = {};  // times √(effective mass)
    Move onB = {};
    double bound = 0;
    double scale = 0;
  };
  using Values = std::vector<double>;
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const Move& moveOf(int body) const { return moves_[at(members_[at(body)])]; }
  static bool isZero(const Move& move) { return move.shift.isZero(0) && move.turn.isZero(0); }
  int memberOf(int body);
  void apply(const Values& impulses, Values& result);
  double largestEigenvalue();
  void findGradient();
  void pointAlongGradient();
  void leaveFace(double step, double length);

  std::span<const PileBody> bodies_;
  std::vector<int> members_;  // by body: in own_, or kNobody
  std::vector<Member> own_;
  std::vector<ScaledRow> rows_;
  std::vector<Move> moves_;  // by member, of what apply() was last called with
  Values impulses_, gradient_, direction_, applied_;
};

}  // namespace careen
