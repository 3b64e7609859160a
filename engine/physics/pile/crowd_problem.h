#pragma once

#include <cstddef>
#include <vector>

#include "physics/pile/crowd_members.h"
#include "physics/solver/contact_problem.h"
#include "physics/solver/contact_rows.h"
#include "physics/solver/contact_solver.h"

namespace careen {

/// A ContactProblem among members of a crowd: velocities, or displacements, of those that move.
class CrowdProblem {
 public:
  using Triple = ContactProblem::Triple;

  explicit CrowdProblem(const CrowdMembers& members) : members_(members) {}

  void begin();
  /// A member, by place, with its velocities [m/s], [rad/s], world, if it is new. Returns its number, or that
  /// of nobody where it does not move.
  int include(int place, const Vec3& velocity, const Vec3& omega);
  /// A contact of bodies by numbers, with the impulse [N s] that their velocities already have of it.
  void add(const ContactProblem::Contact& contact, const RowSide& rowsA, const RowSide& rowsB,
           const Triple& impulse);

  /// For velocities and impulses; `enough` [m/s] as in ContactSolution. False: they are not to be used.
  bool solve(ContactSolver& solver, double enough, int mostFactorisations);

  /// Places of those that move, by number.
  const std::vector<int>& movers() const { return movers_; }
  Vec3 velocity(std::size_t number) const;
  Vec3 omega(std::size_t number) const;
  /// By contact.
  const std::vector<Triple>& impulses() const { return solution_.impulses; }

 private:
  void addImpulses(double sign);

  const CrowdMembers& members_;
  ContactProblem problem_;
  ContactSolution solution_;
  std::vector<int> movers_;
  std::vector<int> numbers_;  // by place
};

}  // namespace careen
