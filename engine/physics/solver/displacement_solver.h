#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "core/math/lanes.h"
#include "core/math/linear_algebra.h"
#include "core/system/team.h"

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
/// Rows of two bodies with one normal are worked on four at a time, and what a team shares is divided in the
/// same way whatever its size: so the bits do not depend on the threads.
///
/// Sources: Y. Nesterov, Soviet Math. Dokl. 27, 1983; B. O'Donoghue & E. Candès, Found. Comput. Math. 15,
/// 2015.
class DisplacementSolver {
 public:
  static constexpr double kCompliance = 1e-3;  ///< [1] c, as a rule

  explicit DisplacementSolver(std::shared_ptr<Team> team = std::make_shared<Team>(1))
      : team_(std::move(team)) {}

  /// For that many bodies, with that c.
  void begin(std::size_t bodies, double compliance = kCompliance);

  struct Body {
    double inverseMass = 0;              ///< [1/kg]
    Mat3 inverseInertia = Mat3::Zero();  ///< [1/(kg m²)] world; zero: it does not turn
  };
  /// Before the rows; one that is not set does not move.
  void setBody(int index, const Body& body);

  /// A row n·δ ≥ bound [m] at the point with that arm [m] from the centre of body a, relative to the point
  /// with that of b; kNobody does not move.
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
  /// Or until every row is off by no more than `enough` [m], as it lacks that, or pushes with that more than
  /// its bound: to rounding. Ends, too, where that comes no nearer: rows contradict each other, and without c
  /// their impulses grow in proportion to what they lack times their effective mass.
  int solveExactly(double enough, int most);

  bool moves(int body) const { return !moveOf(body).shift.isZero(0) || !moveOf(body).turn.isZero(0); }
  const Vec3& displacement(int body) const { return moveOf(body).shift; }  ///< [m]
  const Vec3& turn(int body) const { return moveOf(body).turn; }           ///< [rad]

 private:
  struct Move {
    Vec3 shift = Vec3::Zero();
    Vec3 turn = Vec3::Zero();
  };
  struct Push {  // on a; b is pushed the other way
    Vec3 shift = Vec3::Zero();
    Vec3 turnA = Vec3::Zero();
    Vec3 turnB = Vec3::Zero();
  };
  struct Block {  // up to four rows
    LanesVec armA{}, armB{};
    Lanes scale{}, perScale{};  // √(effective mass), and one by that; 0: no row
    Lanes bound{};
    Lanes impulse{}, ahead{}, next{};
    Push push = {};  // of those ahead
    Vec3 normal = Vec3::UnitZ();
    int a = 0;  // in own_
    int b = 0;
    int rows = 0;
  };
  struct Sums {  // over some of the blocks
    Lanes lacking{}, off{}, back{}, squares{};
  };
  static constexpr std::size_t kMostRanges = 16;
  static constexpr int kNothing = 0;  // in own_
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const Move& moveOf(int body) const { return moves_[at(members_[at(body)])]; }
  int memberOf(int body) const { return body == kNobody ? kNothing : members_[at(body)]; }
  void listBlocksOfMembers();
  template <class Work>
  void forBlocks(const Work& work);
  template <class Ahead>
  void move(const Ahead& ahead);
  template <class Take>
  Sums findResults(const Take& take);
  Lanes resultOf(const Block& block) const;
  void findPush(Block& block) const;
  Move moved(std::size_t member) const;
  double largestEigenvalue();
  template <class Done>
  int descend(int most, const Done& done);

  std::shared_ptr<Team> team_;
  double compliance_ = kCompliance;
  std::vector<int> members_;  // by body: in own_; kNothing for those that do not move
  std::vector<Body> own_;     // after the first
  std::vector<Block> blocks_;
  std::vector<std::size_t> firstOf_;   // by member: in blocksOf_
  std::vector<std::size_t> blocksOf_;  // 2 · block, and 1 where the member is b
  std::vector<Move> moves_;            // by member, of the impulses ahead
  std::vector<Sums> sums_;             // by range
};

}  // namespace careen
