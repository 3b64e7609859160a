#pragma once

#include <array>
#include <span>
#include <vector>

#include "physics/solver/coupled_contacts.h"

namespace careen {

/// Interior-point method for a ContactProblem. Per contact, in Lorentz cones |x_t| ≤ x_0 and [m/s]:
///
///   r = (μ λ_n, λ_t)/mass,   w = (u_n/μ + |u_t|, u_t),   r ∘ w = 0;   half-lines: r = λ_n/mass, w = u_n.
///
/// What admits all of space has no cone to stay in: u = 0 by the augmented Lagrangian, a step of its
/// multiplier with each iteration, as far as the stride. An interval has two half-lines: how far λ is from
/// either end, r and width − r, with u_n = w_0 − w_1; one without width has a given λ.
///
/// |u_t| makes the problem one that is not convex. It may be a parameter, to be iterated on (V. Acary, F.
/// Cadoux, C. Lemaréchal, J. Malick, ZAMM 91, 2011): such problems are convex, and where nearly everything
/// sticks their solution is close to the answer. Else its derivative D̃ = d(u_0 + |u_t|, u_t)/du is part of
/// Newton's matrix M + Σ Jᵀ S W² D̃ S J, S = diag(1/μ, 1, 1), which makes it unsymmetric. Scaling W of
/// Nesterov and Todd, predictor and corrector of Mehrotra, as in L. Vandenberghe, The CVXOPT linear and
/// quadratic cone program solvers, 2010. All products r·w have one target, in [m²/s²], so that light and
/// heavy contacts are centred alike: redundant contacts get even shares.
class InteriorPoint {
 public:
  struct Options {
    double start = 1;             ///< [1] r starts at this multiple of V, w at V
    double stride = 0.995;        ///< [1] of the way to the surface of the cones
    double leastCentering = 0;    ///< [1] lower bound of σ
    bool secondOrder = true;      ///< Mehrotra's corrector
    double mostFriction = 0x1p6;  ///< [1] larger μ count as this: u_n/μ must not drown in |u_t|
  };

  /// With `slips`, one for each contact, |u_t| is no unknown but that number [m/s], and the problem convex.
  void start(const CoupledContacts& contacts, const Options& options, std::span<const double> slips = {});
  /// One iteration, one factorisation. Returns false if there is no next one.
  bool advance(CoupledContacts& contacts);
  /// Mean r·w [m²/s²].
  double gap() const { return gap_; }
  /// [1] How much of the last Newton step was taken.
  double lastStride() const { return lastStride_; }
  /// [N s]
  std::span<const ContactProblem::Triple> impulses() const { return impulses_; }

 private:
  using Triple = ContactProblem::Triple;
  using Contact = CoupledContacts::Contact;
  struct State {  // of one contact; of a half-line, the first numbers only, of an interval two; in space r is
                  // λ/mass
    double friction = 0;  // μ
    double slips = -1;    // [m/s] instead of |u_t|, if not negative
    bool isInterval = false;
    bool isFree = false;  // has no cone: admits all of space, or one λ
    Triple r{};
    Triple w{};
    Triple point{};                // w̄, the scaling point, of length 1
    double size2 = 0;              // η² [1]: W² = η² (2 w̄w̄ᵀ − J), W² w = r
    Triple scaled{};               // v = W w = W⁻¹ r
    Triple residual{};             // w − (u_n/μ + |u_t|, u_t)
    std::array<double, 2> slip{};  // u_t/|u_t|, the derivative of |u_t|
    Triple changeR{};
    Triple changeW{};
    std::array<double, 2> beyond{};  // of an interval: its products of the changes found first
  };

  void refresh(const CoupledContacts& contacts);
  static void scale(const Contact& contact, State& state, std::array<double, 9>& stiffness);
  enum class Order { kFirst, kSecond };  // kSecond: by the changes found last
  Triple given(const Contact& contact, const State& state, double target, Order order) const;
  void solve(const CoupledContacts& contacts, double centering, Order order);
  double strideToSurface() const;
  bool move(double stride);

  Options options_;
  std::vector<State> states_;
  std::vector<ContactAnswer> answers_;
  std::vector<Triple> impulses_;
  std::vector<double> q_;
  std::vector<double> dq_;
  double gap_ = 0;
  std::vector<std::array<double, 1>> products_;  // r·w of each contact
  double lastStride_ = 1;
};

}  // namespace careen
