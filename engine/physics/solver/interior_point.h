#pragma once

#include <span>
#include <vector>

#include "physics/solver/coupled_contacts.h"

namespace careen {

/// Interior-point method for a ContactProblem. Per contact, in Lorentz cones (|x_t| ≤ x_0) and [m/s]:
///
///   r = (μ λ_n, λ_t)/mass,   w = (u_n/μ + |u_t|, u_t),   r ∘ w → 0,
///
/// half-lines: r = λ_n/mass, w = u_n. The term |u_t| makes the problem no convex one (V. Acary, F. Cadoux, C. Lemaréchal, J.
/// Malick, ZAMM 91, 2011, iterate on it as a parameter; here its derivative is part of Newton's matrix, which becomes
/// unsymmetric). Scaling of Nesterov and Todd, predictor and corrector of Mehrotra, as in L. Vandenberghe, The CVXOPT
/// linear and quadratic cone program solvers, 2010; Eq. numbers in the source are his.
class InteriorPoint {
 public:
  struct Options {
    double start = 1;          ///< [1] r and w start at this multiple of V and its inverse
    double stride = 0.995;     ///< [1] of the way to the cone's surface
    double leastCentering = 0; ///< [1] lower bound of σ
    bool secondOrder = true;   ///< Mehrotra's corrector
  };

  void start(const CoupledContacts& contacts, const Options& options);
  /// From given impulses and the velocities that follow, shifted into the cones by `shift` [m/s].
  void startAt(const CoupledContacts& contacts, std::span<const ContactProblem::Triple> impulses, double shift,
               const Options& options);
  /// One iteration, one factorisation. Returns false if it can do no more.
  bool advance(CoupledContacts& contacts);
  /// Mean r·w [m²/s²].
  double gap() const { return gap_; }
  /// [N s]
  std::span<const ContactProblem::Triple> impulses() const { return impulses_; }

 private:
  using Triple = ContactProblem::Triple;
  struct State {  // of one contact
    Triple r{};
    Triple w{};
    Triple point{};       // w̄, the scaling point, of length 1
    double size2 = 0;     // η²: W² = η² (2 w̄w̄ᵀ − J), W² w = r
    Triple scaled{};      // v = W w = W⁻¹ r
    Triple residual{};    // of w = (u_n/μ + |u_t|, u_t)
    Triple changeR{};
    Triple changeW{};
    std::array<double, 2> slip{};  // u_t/|u_t|
  };

  void refresh(const CoupledContacts& contacts);
  void direct(const CoupledContacts& contacts, double centering, bool corrected);
  double strideToSurface() const;
  void scale(std::size_t c, const CoupledContacts::Contact& contact);

  Options options_;
  std::vector<State> states_;
  std::vector<ContactAnswer> answers_;
  std::vector<Triple> impulses_;
  std::vector<double> q_;
  std::vector<double> dq_;
  double gap_ = 0;
};

}  // namespace careen
