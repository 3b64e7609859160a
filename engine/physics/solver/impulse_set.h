#pragma once

#include <array>

#include "physics/solver/contact_problem.h"

namespace careen {

/// The impulses λ [N s] that a constraint admits, and its law for the relative velocity u = J q − target
/// [m/s]; both normal, tangent, tangent.
struct ImpulseSet {
  using Triple = ContactProblem::Triple;
  using Kind = ContactProblem::Admissible;

  double mass = 0;               ///< [kg] effective, 1/(n M⁻¹ nᵀ)
  double friction = 0;           ///< [1] μ; of kCone, and then > 0
  Kind kind = Kind::kLine;       ///< kLine also without friction
  std::array<double, 2> drag{};  ///< [1] of kLine: λ_t = drag λ_n
  double least = 0;              ///< [N s] of kInterval; so is `most`
  double most = 0;

  /// [N s] Largest tangential impulse, of kCone.
  double limit(double normal) const { return friction * normal; }
  /// Whether it admits one impulse only.
  bool isGiven() const { return kind == Kind::kInterval && least == most; }

  /// How much the law is violated [m/s]: |λ − P(λ − ρ u)|/ρ with ρ = mass, P the projection of λ_n to ≥ 0 and
  /// of λ_t to the disc of radius μ max(0, λ_n), or of λ_n to its interval; in all of space |u|. Zero for
  /// solutions only; finite as μ → ∞, unlike the natural map of De Saxcé's form.
  double violation(const Triple& impulse, const Triple& u) const;

  /// The impulse itself if it is admissible, else one that is, with the same normal part, or zero.
  Triple admissible(const Triple& impulse) const;
};

/// λ = P(λ − ρ u) − ε (λ − centre), with P as above but for the disc's radius μ max(0, λ_n − ρ u_n), as
/// Newton's method wants it: P. Alart, A. Curnier, Comput. Methods Appl. Mech. Eng. 92, 1991. With ε > 0
/// redundant contacts keep the distribution of `centre` but for what has to change.
struct ContactEquation {
  double rho = 0;      ///< [kg]
  double epsilon = 0;  ///< [1] > 0
};

/// A contact's linear answer to a change du of its relative velocity: λ = given − stiffness du.
struct ContactAnswer {
  ContactProblem::Triple given{};     ///< [N s]
  std::array<double, 9> stiffness{};  ///< [kg] row-major; not symmetric where the contact slips
};

/// Newton's step: the equation linearised at λ and u and solved for λ, (I − A + ε I) dλ = … − ρ A du, with A
/// the derivative of P.
ContactAnswer newtonAnswer(const ImpulseSet& set, const ContactEquation& equation,
                           const ContactProblem::Triple& impulse, const ContactProblem::Triple& centre,
                           const ContactProblem::Triple& u);
/// The same with every contact closed and, unless it is on a line or given, sticking.
ContactAnswer stickingAnswer(const ImpulseSet& set, const ContactEquation& equation,
                             const ContactProblem::Triple& centre, const ContactProblem::Triple& u);
/// |λ − P(λ − ρ u) + ε (λ − centre)|/ρ [m/s].
double equationError(const ImpulseSet& set, const ContactEquation& equation,
                     const ContactProblem::Triple& impulse, const ContactProblem::Triple& centre,
                     const ContactProblem::Triple& u);

}  // namespace careen
