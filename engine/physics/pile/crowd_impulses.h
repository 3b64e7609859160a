#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "physics/pile/crowd_articulations.h"
#include "physics/pile/crowd_contacts.h"
#include "physics/pile/crowd_direct.h"
#include "physics/pile/crowd_loads.h"
#include "physics/pile/crowd_members.h"
#include "physics/pile/crowd_memory.h"
#include "physics/pile/projection.h"
#include "physics/pile/solver.h"

namespace careen {

/// Impulses of a crowd's step: such that no gap becomes negative within it. Velocities are those of its
/// middle.
class CrowdImpulses {
 public:
  CrowdImpulses(const CrowdMembers& members, const CrowdLoads& loads, CrowdContacts& contacts,
                CrowdArticulations& articulations, CrowdMemory& memory);

  /// Of the contacts of the step, the last impulses being the first guess.
  void find();
  /// Keeps them at the points of the contacts, for the next step.
  void keep();
  /// Shifts that undo the penetration which the step would end with at the velocities found: Gauss–Seidel
  /// stops early, and gaps below zero are no bound to it. They need no rows of their own, unlike a
  /// projection. None where they stop so early, too, that others go deeper: among wedged boxes.
  void shift(const PileProjection& projection);
  void dontShift() { shifts_ = false; }

  /// As they stand, by row and by place.
  PileSolver& solver() { return solver_; }
  const PileSolver& solver() const { return solver_; }
  bool isShifted(int body) const { return shifts_ && solver_.isShifted(body); }
  /// [m] How far shifts move points of it, at the most.
  double shiftOf(int body) const;
  /// Solves the rows of solver() directly, if that is tried and succeeds.
  bool solveDirectly() { return direct_.solve(solver_); }
  /// Sweeps over the rows of solver(), and the joints in between, until those change little. Returns the
  /// number of manifold solves.
  std::int64_t sweep(int sweeps);
  /// The joints alone.
  void solveJoints() { direct_.solveJoints(solver_); }

  /// [J] At the velocities found, whose angular momentum the body has; and before impulses.
  double kineticEnergy(std::size_t place) const;
  double kineticBefore(std::size_t place) const { return kinetic_[place]; }
  /// Whether the contacts of the step added too much to the kinetic energy: where Gauss–Seidel stopped too
  /// early.
  bool gainedEnergy() const;

  /// Of the solves since it was last asked, before bounces and shifts.
  ContactResiduals takeResiduals() { return std::exchange(residuals_, {}); }
  /// Contact points, of all steps.
  std::int64_t rows() const { return rowCount_; }

 private:
  void load();
  double loadBody(std::size_t place);
  void solve();
  void findPushing();
  void wakeJoined();
  double slowestBounce(const PileManifold& manifold) const;
  PileSolver::Extent lookForRows(PileManifold& manifold) const;
  void addRows(PileManifold& manifold, PileSolver::Extent next);

  const CrowdMembers& members_;
  const CrowdLoads& loads_;
  CrowdContacts& contacts_;
  CrowdArticulations& articulations_;
  CrowdMemory& memory_;
  PileSolver solver_;
  CrowdDirect direct_;
  std::vector<PileSolver::Extent> rowsOf_;  // by index in near(): where its own begin
  std::vector<double> pushing_;             // [m/s] largest speed of a body and of those near it
  std::vector<double> kinetic_;             // [J] by place
  double speed_ = 0;                        // [m/s] largest of its bodies: S of the residuals
  bool shifts_ = false;                     // in this step
  ContactResiduals residuals_;
  bool isOnBelts_ = false;  // in this step
  std::int64_t rowCount_ = 0;
};

}  // namespace careen
