#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "physics/world/contact_residuals.h"

namespace careen {

/// Velocities after impulses in friction cones; with accelerations in place of velocities, accelerations
/// under contact forces. Time steps, impacts, contact forces and the test for rest are this one problem. So
/// are ropes and limits (no friction) and joints, if there are any: a "contact" is a triple of rows and the
/// impulses that it admits.
///
/// Velocities q are six numbers per body, that of the centre of mass in the world frame and ω in the body's
/// frame, so that M is diagonal. Contact c has a normal row n and two tangential rows t, orthonormal in the
/// world; u = J q − target is its relative velocity (normal, tangent, tangent), λ its impulse on a along the
/// rows.
///
///   q = q₀ + M⁻¹ Jᵀ λ
///   0 ≤ λ_n ⊥ u_n ≥ 0,   |λ_t| ≤ μ λ_n,   λ_t = −μ λ_n u_t/|u_t| where u_t ≠ 0   (Signorini, Coulomb)
///   on a line: λ_t = −μ λ_n · slip, whatever u_t is
///   in all of space: u = 0, whatever λ is
///   in an interval: λ_n at its lower end where u_n > 0, at its upper one where u_n < 0
///
/// The same in one line (G. De Saxcé, Z.-Q. Feng, Math. Comput. Modelling 28, 1998):
/// K = {|λ_t| ≤ μ λ_n} ∋ λ ⊥ (u_n + μ|u_t|, u_t) ∈ K*.
///
/// Redundant contacts leave λ undetermined, friction sometimes even q; and accelerations, or contacts that
/// slip, may leave no solution (P. Painlevé, C. R. Acad. Sci. 121, 1895).
struct ContactProblem {
  static constexpr std::size_t kAxes = 6;
  static constexpr int kNobody = -1;          ///< what never moves: its part of the rows is zero
  using Row = std::array<double, 2 * kAxes>;  ///< a's six, then b's
  using Triple = std::array<double, 3>;       ///< normal, tangent, tangent

  enum class Admissible : unsigned char {
    kCone,      ///< |λ_t| ≤ μ λ_n: a contact; without friction a half-line, a rope or a limit
    kLine,      ///< λ_n ≥ 0, λ_t = −μ λ_n · slip: a contact that slips in a given direction
    kSpace,     ///< every λ: a joint. Rows that it does not need are zero, not the first
    kInterval,  ///< λ_n from `least` to `most`: a joint's dry friction. The other rows are zero
  };

  struct Contact {
    int a = kNobody;  ///< index of a body, or kNobody; at least one is a body
    int b = kNobody;
    std::array<Row, 3> rows{};
    double friction = 0;  ///< [1] μ ≥ 0; may be very large
    Triple target{};      ///< [m/s]
    Admissible admissible = Admissible::kCone;
    std::array<double, 2> slip{};  ///< [1] unit; of kLine
    double least = 0;              ///< [N s] of kInterval; so is `most`
    double most = 0;
    /// [1] unit, along the rows. Empty: u_n ≥ 0 is the condition. Else it is d·u ≥ 0 for one of them, and the
    /// contact takes part only where u without it is against all, see ContactSolver.
    std::vector<Triple> directions = {};
  };

  /// Whether its first row is along a normal; those of joints that hold mirrors turn round.
  static bool hasNormal(const Contact& contact) {
    return contact.admissible != Admissible::kSpace && contact.admissible != Admissible::kInterval;
  }

  std::vector<double> inverseMass;  ///< six per body [1/kg, 1/(kg m²)], all positive
  std::vector<double> free;         ///< q₀, six per body [m/s, rad/s]
  std::vector<Contact> contacts;
};

struct ContactSolution {
  std::vector<double> velocities;                ///< q, six per body [m/s, rad/s]
  std::vector<ContactProblem::Triple> impulses;  ///< λ [N s]; on entry the warm start, if as many as contacts
  /// [m/s] On entry: a residual that is as good as none to the caller, if the impulses are much larger.
  double enough = 0;
  double residual = 0;  ///< [m/s] largest of the contacts' natural maps (impulse_set.h), of what is returned
  double scale = 0;  ///< [m/s] V, the largest contact speed |J q₀ − target|, or a given λ/mass: what the
                     ///< residual is measured against
  bool solved =
      false;  ///< the residual is small enough, see ContactSolver; otherwise the best iterate is kept
  ContactResiduals residuals = {};  ///< of what is returned
  int factorisations = 0;           ///< of the matrix of all bodies
};

}  // namespace careen
