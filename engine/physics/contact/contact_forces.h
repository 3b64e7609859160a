#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "physics/solver/contact_problem.h"
#include "physics/solver/contact_solver.h"

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
/// matrix unsymmetric.
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
    kStick,  ///< normal force, sticks
    kSlip,   ///< normal force, slips or begins to
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

  std::span<const double> accelerations() const { return a_; }
  std::span<const Force> forces() const { return forces_; }
  /// Residual n a − target_n or a tangent's [m/s²], of the last solution.
  double excess(std::size_t contact, std::size_t row) const { return excess_[contact][row]; }
  /// [m/s²] Scale for the rounding error of the excess.
  double scale() const { return scale_; }
  /// [kg] Effective mass of the contact along its normal.
  double normalMass(std::size_t contact) const { return masses_[contact][0]; }

 private:
  double along(const Contact& contact, std::size_t row, std::span<const double> of) const;
  void push(const Contact& contact, const Force& force, std::span<double> onto) const;
  void weigh();
  void accelerate(std::span<const double> free);
  Mode modeOf(std::size_t contact);
  bool stands(std::span<Mode> modes) const;
  double violation(std::span<const Mode> modes) const;
  void factorise(std::span<const Mode> modes);
  void assemble(std::span<const Mode> modes);
  std::array<double, 9> stiffnessOf(std::size_t contact, Mode mode) const;
  double improve(std::span<const Mode> modes);

  ContactProblem problem_;
  ContactSolution solution_;
  ContactSolver solver_;
  std::vector<double> mass_;
  std::vector<std::array<double, 2>> masses_;  // [kg] effective: normal, tangential
  std::vector<double> a_;
  std::vector<Force> forces_;
  std::vector<Force> best_;
  std::vector<Force> excess_;
  std::vector<double> z_;
  std::vector<double> matrix_;
  std::vector<std::size_t> pivots_;
  double scale_ = 0;
  double penalty_ = 0;  // [1]
};

}  // namespace careen
