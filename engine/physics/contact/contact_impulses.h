#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "physics/contact/group_loads.h"
#include "physics/contact/touching_group.h"
#include "physics/solver/contact_problem.h"
#include "physics/solver/contact_rows.h"
#include "physics/solver/contact_solver.h"

namespace careen {

/// Impulses at contacts of a group: its ContactProblem, of the bodies that have contacts. First begin() and
/// setFree(), then one add() for each contact, then solve().
class ContactImpulses {
 public:
  using Triple = ContactProblem::Triple;

  explicit ContactImpulses(const TouchingGroup& group) : group_(group), turned_(group.size()) {}

  /// A problem without contacts, of the bodies that have these. They turn about the principal axes that they
  /// have at `turned`, from rest.
  void begin(std::span<const ContactFeature> contacts, const GroupState& turned);
  /// Its bodies, as indices of the group.
  std::span<const std::size_t> movers() const { return movers_; }
  /// The velocities that they would have `h` [s] after `from` without contacts.
  void setFree(const GroupState& from, const GroupLoads& loads, double h);
  /// Rows with the arms and the normal of that geometry; the law is that of a contact without gap and bias.
  ContactProblem::Contact& add(const ContactFeature& feature, const ContactState& geometry);
  /// What solve() starts from: an impulse for each contact, or none.
  void startFrom(const Triple& warm) { solution_.impulses.push_back(warm); }
  /// The contact's law holds for its velocities at the end of the step, where arms and normal are others than
  /// in the rows: `end`, if the bodies get to `to`.
  void aimAtEnd(std::size_t contact, const ContactFeature& feature, const ContactState& geometry,
                const ContactState& end, const GroupState& to);
  /// To a residual of so much [m/s]. Throws NumericalError if that costs more than it may.
  bool solve(double enough);

  /// [N s] By contact, along its normal and tangents; [m/s] the residual to which they are solved.
  const std::vector<Triple>& impulses() const { return solution_.impulses; }
  double residual() const { return solution_.residual; }
  /// [m/s] and [rad/s] in the body's frame: velocities of one of the movers after them.
  Vec3 velocity(std::size_t mover) const;
  Vec3 spinBody(std::size_t mover) const;
  /// What impulses at contacts give to each body of the group that is not held.
  void sum(std::span<const ContactFeature> contacts, std::span<const ContactState> geometry,
           std::span<const Triple> impulses, std::vector<BodyImpulse>& sums);

  /// Factorisations so far, each times the bodies and contacts in it: the cost; how much more may be spent.
  double work() const { return work_; }
  void limitWork(double most) { mostWork_ = work_ + most; }
  /// Of the problems solved since it was last asked.
  ContactResiduals takeResiduals() { return solver_.takeResiduals(); }

 private:
  const TouchingGroup& group_;
  std::vector<int> places_;          // by body: index in the problem, or kNobody
  std::vector<std::size_t> movers_;  // by index in the problem
  std::vector<Mat3> turned_;         // by body: its principal axes
  ContactProblem problem_;
  ContactSolution solution_;
  ContactSolver solver_;
  std::vector<std::vector<std::array<double, ContactProblem::kAxes>>> parts_;  // of sums, by body
  double length_ = 0;                                                          // [s] of the step
  double work_ = 0;
  double mostWork_ = std::numeric_limits<double>::infinity();
};

}  // namespace careen
