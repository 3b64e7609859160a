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

/// Restitution in a crowd's step, by the law of resolveImpact() as it is without friction: e G + (1−e) P, G
/// being generalized reflections and P the plastic projection. What it looks at is what the impulses reach.
///
/// Velocities are changes by impulses. A contact that does not strike begins at rest, or parting: what forces
/// do in the step is carried by the impulses of the step.
class CrowdRestitution {
 public:
  static constexpr int kNobody = -1;
  /// A contact point of a body that impulses reached.
  struct Point {
    int slot = 0;   ///< of its manifold
    int index = 0;  ///< in it
    bool strikes = false;
    std::array<int, 2> bodies{kNobody, kNobody};  ///< in bodies(); kNobody does not move
    std::array<Vec3, 2> arms = {};                ///< [m] from the centre of mass
    Vec3 normal = Vec3::UnitZ();                  ///< [1] to the first of the two
    double mass = 0;                              ///< [kg] effective, along the normal
    double restitution = 0;                       ///< [1]
    double before = 0;                            ///< [m/s] normal speed; negative: approaching
    double impulse = 0;                           ///< [N s] of the solution that is being found
    double ofPass = 0;                            ///< [N s] of one of its projections
    double plastic = 0;                           ///< [N s] of P
    double whole = 0;                             ///< [N s] of the law
    double friction = 0;                          ///< [1]
    Vec3 slip = Vec3::Zero();                     ///< [m/s] tangential velocity before
    Vec3 rubbing = Vec3::Zero();                  ///< [N s] friction on the first of the two, of P with it
    double taken = 0;                             ///< [J] from its bodies by P with friction
    double afterPlastic = 0;                      ///< [m/s] normal speed after P
    double added = 0;                             ///< [m/s] what restitution adds to it
  };
  /// A body that has such points.
  struct Reached {
    int place = 0;
    SolverBody mass = {};
    Vec3 velocity = Vec3::Zero();  ///< [m/s] changes: of what is being found, in the end what restitution
    Vec3 omega = Vec3::Zero();     ///< [rad/s] adds, e (G − P)
    bool isListed = false;         ///< `points` are all it has
    bool changed = false;
    int stirred = 0;  ///< sweep in which it was pushed by more than matters
    std::vector<int> points = {};

    bool moves() const { return !velocity.isZero(0) || !omega.isZero(0); }
  };

  CrowdRestitution(const CrowdMembers& members, const CrowdContacts& contacts)
      : members_(members), contacts_(contacts) {}

  /// Of the points of near contacts that have a row, at the places of now.
  void begin();
  /// That point does, with that speed [m/s].
  void strike(int slot, int index, double approach);
  /// Approach slower than `slow` [m/s] is no impact.
  void resolve(double slow);

  std::span<const Point> points() const { return points_; }
  std::span<const Reached> bodies() const { return bodies_; }

 private:
  int reach(int place);
  int listManifold(int slot);
  void listPoints(Reached& body);
  Vec3 change(const Point& point) const;
  double speed(const Point& point) const { return point.before + dot(point.normal, change(point)); }
  Vec3 sliding(const Point& point) const;
  void push(const Point& point, const Vec3& impulse);
  void push(const Point& point, double impulse) { push(point, Vec3(impulse * point.normal)); }
  void note(const Point& point);
  /// Velocities are those that these impulses give.
  void setVelocities(double (*impulseOf)(const Point&));
  void restart();
  void findApproaching(std::vector<int>& approaching) const;
  void findFront(std::span<const int> more);
  std::vector<double> levels() const;
  void reflect(double threshold);
  void guess(std::span<const int> ofManifold);
  double solveAt(Point& point);
  bool isDue(const Point& point, int sweep) const;
  void stir(const Point& point, int sweep);
  void project(std::span<const int> chosen);
  void projectAll(double most);
  double rubAt(Point& point);
  void rub();

  const CrowdMembers& members_;
  const CrowdContacts& contacts_;
  double slow_ = 0;
  double fastest_ = 0;           // [m/s] that strikes
  std::size_t visits_ = 0;       // of points, in projections
  std::vector<int> firstSlot_;   // by place: of its manifolds in slots_
  std::vector<int> slots_;       // near, by place
  std::vector<int> reachedAt_;   // by place: in bodies_, or kNobody
  std::vector<int> firstPoint_;  // by slot: in points_, or kNobody
  std::vector<Point> points_;
  std::vector<Reached> bodies_;
  std::vector<int> front_;    // points that may approach
  std::vector<int> changed_;  // bodies, since the front was found
};

}  // namespace careen
