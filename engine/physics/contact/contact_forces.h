#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "physics/solver/contact_problem.h"
#include "physics/solver/contact_solver.h"
#include "physics/solver/coupled_contacts.h"

namespace careen {

/// Contact forces between bodies in persistent contact, and the resulting accelerations: the ContactProblem
/// with accelerations in place of velocities; targets are the accelerations that the geometry requires
/// (centripetal terms, with their sign changed).
///
/// Which contacts push, stick or slip, ContactSolver finds: findModes. While none of that changes, the forces
/// follow from linear equations: solveGiven, by the augmented Lagrangian in the coordinates of the bodies
/// (multipliers of Hestenes and Powell), so that the matrix M + Jᵀ D J stays nonsingular however redundant
/// the contacts are. Of all force distributions it finds that of least norm, weighted by effective mass,
/// because the multipliers start from 0 and only move along the rows. Friction of slipping contacts makes the
/// matrix unsymmetric. Both share the sparse factorisation of CoupledContacts.
class ContactForces {
 public:
  static constexpr std::size_t kAxes = ContactProblem::kAxes;
  static constexpr int kNobody = ContactProblem::kNobody;
  using Contact = ContactProblem::Contact;
  using Row = ContactProblem::Row;
  using Force = ContactProblem::Triple;  ///< [N] normal, tangent, tangent

  enum class Mode : unsigned char {
    kOff,    ///< no force
    kOn,     ///< normal force, no friction
    kStick,  ///< normal force, sticks; or a joint's condition that holds, a grip that keeps its rate
    kSlip,   ///< normal force, slips or begins to; or a grip that has all its force
  };

  /// Six 1/M per body [1/kg, 1/(kg m²)], all positive. Empties the contacts.
  void setBodies(std::span<const double> inverseMass);
  /// Their `slip` is filled in by findModes where a contact only begins to slip.
  std::vector<Contact>& contacts() { return problem_.contacts; }
  const std::vector<Contact>& contacts() const { return problem_.contacts; }

  /// Finds modes and forces. Returns false if there are none (P. Painlevé, C. R. Acad. Sci. 121, 1895).
  bool findModes(std::span<const double> free, std::span<Mode> modes);
  /// Forces with given modes; no inequality is checked. Returns false if the conditions contradict each
  /// other; slightly they may, as two ends of an edge that both stick while the body rotates out of line: the
  /// residual is distributed by least squares. Redundant forces are those nearest to `guess`, one per
  /// contact, or to zero.
  bool solveGiven(std::span<const double> free, std::span<const Mode> modes,
                  std::span<const Force> guess = {});

  /// Of the modes found since it was last asked.
  ContactResiduals takeResiduals() { return solver_.takeResiduals(); }

  std::span<const double> accelerations() const { return a_; }
  std::span<const Force> forces() const { return forces_; }
  /// Residual n a − target_n or a tangent's [m/s²], of the last solution.
  double excess(std::size_t contact, std::size_t row) const { return excess_[contact][row]; }
  /// [m/s²] Scale for the rounding error of the excess.
  double scale() const { return scale_; }
  /// Whether the determinant of the last forces with given modes was negative. Friction makes their equations
  /// unsymmetric: the determinant passes zero at a moment at which the forces have no bound (Painlevé), and
  /// contacts that push before it pull after it.
  bool isTurned() const { return turned_; }
  /// [kg] Effective mass of the contact along its normal.
  double normalMass(std::size_t contact) const { return masses_[contact]; }

 private:
  void set(std::span<const double> free);
  void look();
  Mode modeOf(std::size_t contact);
  bool stands(std::span<Mode> modes) const;
  double violation(std::span<const Mode> modes) const;
  void answer(std::span<const Mode> modes);
  double improve();

  ContactProblem problem_;
  ContactSolution solution_;
  ContactSolver solver_;
  CoupledContacts coupled_;
  // As listed:
  std::vector<double> masses_;  // [kg] effective, along the normal
  std::vector<double> a_;
  std::vector<Force> forces_;
  std::vector<Force> excess_;
  // In the order of coupled_:
  std::vector<Force> multipliers_;
  std::vector<Force> best_;
  std::vector<Force> u_;
  std::vector<ContactAnswer> answers_;
  std::vector<double> q_;
  std::vector<double> dq_;
  double scale_ = 0;
  double penalty_ = 0;  // [1]
  bool turned_ = false;
};

}  // namespace careen
