#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/pile/crowd_contacts.h"
#include "physics/pile/crowd_members.h"
#include "physics/pile/solver_body.h"

namespace careen {

/// A contact point of a body that impulses reached.
struct ReachedPoint {
  int slot = 0;   ///< of its manifold
  int index = 0;  ///< in it
  bool strikes = false;
  std::array<int, 2> bodies{};    ///< of ReachedContacts; kNobody does not move
  std::array<Vec3, 2> arms = {};  ///< [m] from the centre of mass
  Vec3 normal = Vec3::UnitZ();    ///< [1] to the first of the two
  double mass = 0;                ///< [kg] effective, along the normal
  double restitution = 0;         ///< [1]
  double friction = 0;            ///< [1]
  double before = 0;              ///< [m/s] normal speed; negative: approaching
  Vec3 slip = Vec3::Zero();       ///< [m/s] tangential velocity before
  double ofPass = 0;              ///< [N s] of the projection that is being found
  double impulse = 0;             ///< [N s] of the solution that it is a part of
  double plastic = 0;             ///< [N s] of P
  double whole = 0;               ///< [N s] of the law
  Vec3 rubbing = Vec3::Zero();    ///< [N s] friction on the first of the two, of P with it
  double taken = 0;               ///< [J] from its bodies by P with friction
  double afterPlastic = 0;        ///< [m/s] normal speed after P
  double added = 0;               ///< [m/s] what restitution adds to it
};

/// A body that has such points.
struct ReachedBody {
  int place = 0;
  SolverBody mass = {};
  Vec3 velocity = Vec3::Zero();  ///< [m/s] changes by impulses
  Vec3 omega = Vec3::Zero();     ///< [rad/s]
  bool isListed = false;         ///< `points` are all it has
  bool changed = false;
  int stirred = 0;  ///< sweep in which it was pushed by more than matters
  std::vector<int> points = {};

  bool moves() const { return !velocity.isZero(0) || !omega.isZero(0); }
};

/// The contact points of a crowd that impulses reach, and the bodies that they push: listed as they are
/// reached, from those that strike on. Velocities are changes by impulses.
class ReachedContacts {
 public:
  static constexpr int kNobody = -1;

  ReachedContacts(const CrowdMembers& members, const CrowdContacts& contacts)
      : members_(members), contacts_(contacts) {}

  /// Of the points of near contacts that have a row, at the places of now.
  void begin();
  /// That point strikes, with that speed [m/s].
  void strike(int slot, int index, double approach);
  double fastest() const { return fastest_; }  ///< [m/s] that strikes

  std::span<ReachedPoint> points() { return points_; }
  std::span<const ReachedPoint> points() const { return points_; }
  std::span<const ReachedBody> bodies() const { return bodies_; }
  ReachedPoint& operator[](int point) { return points_[static_cast<std::size_t>(point)]; }
  const ReachedPoint& operator[](int point) const { return points_[static_cast<std::size_t>(point)]; }

  /// [m/s] Of its relative velocity, by impulses.
  Vec3 change(const ReachedPoint& point) const;
  double speed(const ReachedPoint& point) const { return point.before + dot(point.normal, change(point)); }
  Vec3 sliding(const ReachedPoint& point) const;
  /// [kg] Effective, along a vector of that length.
  double massAlong(const ReachedPoint& point, const Vec3& vector, double length) const;

  void push(const ReachedPoint& point, const Vec3& impulse);
  void push(const ReachedPoint& point, double impulse) { push(point, Vec3(impulse * point.normal)); }
  /// Velocities are those that these impulses give.
  void setVelocities(double (*impulseOf)(const ReachedPoint&));
  /// Exchanges the velocities of the point's bodies with these.
  struct Velocities {
    std::array<Vec3, 2> velocity{Vec3::Zero(), Vec3::Zero()};
    std::array<Vec3, 2> omega{Vec3::Zero(), Vec3::Zero()};
  };
  void swap(const ReachedPoint& point, Velocities& velocities);

  /// The bodies of that point count as pushed, as after push().
  void note(const ReachedPoint& point);
  /// The points of bodies that were pushed since it was last asked, and these; sorted.
  void findFront(std::span<const int> more, std::vector<int>& front);
  /// use(points of it), for each of those bodies.
  template <class Use>
  void forPushed(const Use& use) {
    for (const int body : changed_) {
      ReachedBody& reached = bodies_[static_cast<std::size_t>(body)];
      reached.changed = false;
      listPoints(body);
      use(std::span<const int>(bodies_[static_cast<std::size_t>(body)].points));
    }
    changed_.clear();
  }

  /// Sweeps that solve again only what was pushed: solve(point) returns by how much [m/s], and nothing where
  /// it need not; at most so many sweeps, until none does by more than `enough`. `chosen` may grow in
  /// between(), after each sweep.
  template <class Solve, class Between>
  void sweep(const std::vector<int>& chosen, int most, double enough, const Solve& solve,
             const Between& between);

 private:
  int reach(int place);
  int listManifold(int slot);
  void listPoints(int body);
  bool isDue(const ReachedPoint& point, int sweep) const;
  void stir(const ReachedPoint& point, int sweep);

  const CrowdMembers& members_;
  const CrowdContacts& contacts_;
  double fastest_ = 0;
  std::vector<int> firstSlot_;   // by place: of its manifolds in slots_
  std::vector<int> slots_;       // near, by place
  std::vector<int> reachedAt_;   // by place: in bodies_, or kNobody
  std::vector<int> firstPoint_;  // by slot: in points_, or kNobody
  std::vector<ReachedPoint> points_;
  std::vector<ReachedBody> bodies_;
  std::vector<int> changed_;  // bodies, since it was last asked
};

template <class Solve, class Between>
void ReachedContacts::sweep(const std::vector<int>& chosen, int most, double enough, const Solve& solve,
                            const Between& between) {
  for (ReachedBody& body : bodies_) {
    body.stirred = 0;
  }
  bool moves = true;
  for (int sweep = 1; sweep <= most && moves; ++sweep) {
    moves = false;
    for (const int p : chosen) {
      ReachedPoint& point = (*this)[p];
      if (isDue(point, sweep) && solve(point) > enough) {
        stir(point, sweep);
        moves = true;
      }
    }
    between();
  }
}

}  // namespace careen
