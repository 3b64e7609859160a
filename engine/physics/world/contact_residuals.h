#pragma once

#include <algorithm>
#include <cstdint>

namespace careen {

/// How well contact problems (physics/solver/contact_problem.h) were solved: the largest over all of them and
/// their contacts, without units. With S the largest speed [m/s] of a problem (accelerations likewise), Λ its
/// largest |λ| [N s], and u = J q − target:
///
///   primal            max(0, −u_n)/S
///   dual              max(0, −λ_n, |λ_t| − μ λ_n)/Λ
///   complementarity   |λ_n u_n + min(μ λ_n, Λ) |u_t| + λ_t·u_t|/(S Λ)
///
/// They measure K* ∋ (u_n + μ|u_t|, u_t) ⊥ λ ∈ K (G. De Saxcé, Z.-Q. Feng, Math. Comput. Modelling 28, 1998;
/// V. Acary, M. Brémond, O. Huber, "On solving contact problems with Coulomb friction", 2018), the velocity
/// being the primal and the impulse the dual unknown. Λ in the minimum keeps a huge μ from making slip of
/// rounding errors. Where friction has a given direction, dual has |λ_t + μ λ_n slip| and complementarity λ_n
/// u_n alone.
struct ContactResiduals {
  std::int64_t problems = 0;
  double primal = 0;           ///< [1]
  double dual = 0;             ///< [1]
  double complementarity = 0;  ///< [1]

  void add(const ContactResiduals& other) {
    problems += other.problems;
    primal = std::max(primal, other.primal);
    dual = std::max(dual, other.dual);
    complementarity = std::max(complementarity, other.complementarity);
  }
};

}  // namespace careen
