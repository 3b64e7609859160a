#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "physics/contact/contact_feature.h"
#include "physics/pile/crowd_members.h"
#include "physics/pile/crowd_problem.h"
#include "physics/pile/solver.h"
#include "physics/solver/contact_solver.h"

namespace careen {

/// The joints among members of a crowd, and of these with the world. Their conditions (joint_rows) hold at
/// the ends of steps: impulses at the start of a step lead there but for the third order of its length, as
/// those of contacts do, and what is left is closed at once by the smallest displacement, which is never
/// velocity. In between, bodies go straight: a joint opens by the eighth of arm × (turn in the step)².
///
/// All joints are one block, solved by the ContactSolver: one by one, a chain of ten would take thousands of
/// sweeps.
///
/// Limits and ropes stop without restitution here.
class CrowdArticulations {
 public:
  explicit CrowdArticulations(CrowdMembers& members) : members_(members), close_(members) {}

  /// Those of members that have not let go at that time [s]. Velocities are those of the middle of the last
  /// step: what lets go now gives its impulse for the other half.
  void list(double time);
  bool any() const { return !conditions_.empty(); }
  /// A joint with the places of its ends: from kOutside on those of bodies that are no members, as they never
  /// move, and of the world.
  static constexpr int kOutside = 1 << 30;
  struct Listed {
    const Joint* joint = nullptr;
    int a = 0;
    int b = 0;
    double effort = 0;  ///< [N m] or [N] of its motor and drive, at the most
  };
  const std::vector<Listed>& joints() const { return joints_; }
  /// Of the body at such a place, now.
  Pose poseOf(int place) const;
  bool isJoined(int place) const { return isIn(isJoined_, place); }
  /// Whether a joint of it lets go one day, or has a motor.
  bool mayChange(int place) const { return isIn(mayChange_, place); }

  // Conditions on velocities in a solver.
  /// That they hold at the end of the step, to first order. Members begin with the impulses of the step
  /// before.
  void aimAtEnd(PileSolver& solver);
  /// And to second order, at the velocities found.
  void bend(const PileSolver& solver);
  /// The impulses are those of the step, to be kept for the next.
  void keep();
  /// That they change as they do now.
  void keepRates();
  /// Adds those conditions, after the bodies' velocities, and takes what impulses solve them.
  void addTo(CrowdProblem& problem, const PileSolver& solver) const;
  void take(std::span<const CrowdProblem::Triple> impulses);

  /// Displaces members until all joints are closed to a part of the tolerance; with more conditions, each
  /// time at the places of then. Returns whether any moved, and then how far [m] points of each did, by
  /// place.
  using AddConditions = std::function<void(CrowdProblem& displacements)>;
  bool close(const AddConditions& addMore = {});
  const std::vector<double>& closedBy() const { return closedBy_; }

 private:
  using Triple = CrowdProblem::Triple;
  struct Condition {
    ContactFeature feature;
    ContactState state = {};
    Triple target{};
    Triple impulse{};
    Triple kept{};  // of the step before, or of this one while it bounces
    bool acts = false;
  };
  Kinematics motionOf(int place, const PileSolver* solver) const;
  TouchingShape shapeOf(const JointEnd& end) const;
  bool isIn(const std::vector<char>& places, int place) const {  // who came since is not
    return any() && at(place) < places.size() && places[at(place)] != 0;
  }
  bool moves(int place) const;
  void letGo(const Condition& condition);
  template <class VelocityOf, class OmegaOf>
  void add(const Condition& condition, const Triple& target, const Triple& impulse, CrowdProblem& problem,
           const VelocityOf& velocityOf, const OmegaOf& omegaOf) const;
  bool closes(const Condition& condition) const;
  void lookAt(Condition& condition, const PileSolver* solver) const;
  Vec3 secondOrder(const Condition& condition, const PileSolver& solver) const;
  double mostOpen() const;
  void displace();

  CrowdMembers& members_;
  std::vector<Condition> conditions_;
  std::vector<Listed> joints_;
  std::vector<char> isJoined_;   // by place
  std::vector<char> mayChange_;  // likewise
  double span_ = 0;              // [s] of the impulses kept
  CrowdProblem close_;
  ContactSolver closer_;
  std::vector<double> closedBy_;  // [m] by place
};

}  // namespace careen
