#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "physics/solver/contact_problem.h"

namespace careen {

/// The law of one contact, as its relative velocity u = J q − target [m/s] and impulse λ [N s] see it.
struct ContactCone {
  using Triple = ContactProblem::Triple;

  double mass = 0;      ///< [kg] effective, 1/(n M⁻¹ nᵀ)
  double friction = 0;  ///< [1] μ; 0 where `onLine`
  bool onLine = true;   ///< λ is on a half-line: no friction, or one of given direction
  std::array<double, 2> drag{};  ///< [1] of such a half-line: λ_t = drag λ_n

  /// Largest violation of the law [m/s], the natural map of Alart and Curnier's equations with ρ = mass:
  /// |λ − P(λ − ρ u)|/ρ, where P projects λ_n to ≥ 0 and λ_t to the disc of radius μ max(0, λ_n). It is zero for
  /// solutions only, and finite for μ → ∞.
  double violation(const Triple& impulse, const Triple& u) const;

  /// The admissible impulse nearest to this one, the normal part kept.
  Triple admissible(const Triple& impulse) const;
};

/// The contact's linear answer to a change of its relative velocity: λ = given − stiffness du.
struct ContactAnswer {
  ContactProblem::Triple given{};        ///< [N s]
  std::array<double, 9> stiffness{};     ///< [kg] row-major, not symmetric
};

enum class ContactMode : unsigned char { kOpen, kStick, kSlip };

/// Newton's equations for λ = P(λ − ρ u), solved for λ by (I − A + ε I)⁻¹, A the derivative of P: P. Alart, A. Curnier,
/// Comput. Methods Appl. Mech. Eng. 92, 1991. With ε > 0 redundant contacts keep the distribution of λ but for what has
/// to change; ρ [kg].
ContactMode answerByNewton(const ContactCone& cone, const ContactProblem::Triple& impulse,
                           const ContactProblem::Triple& u, double rho, double epsilon, ContactAnswer& answer);
/// The same with the contact closed and sticking whatever λ and u say.
void answerSticking(const ContactCone& cone, const ContactProblem::Triple& impulse, const ContactProblem::Triple& u,
                    double rho, double epsilon, ContactAnswer& answer);

}  // namespace careen
