#pragma once

#include <span>
#include <utility>
#include <vector>

#include "physics/solver/contact_newton.h"
#include "physics/solver/contact_problem.h"
#include "physics/solver/coupled_contacts.h"
#include "physics/solver/interior_point.h"

namespace careen {

/// Solves a ContactProblem, or says that it did not. In this order, until the residual is small enough:
///
///   1. no impulses;
///   2. without a warm start, and where only small residuals will do: Newton's method, all contacts sticking
///      in its first step; accepted if everything stands (however heavy the top of a stack). Without friction
///      at any contact it is accepted whatever moves: the velocities are unique;
///   3. proximal points from the warm start, or from no impulses if there is none;
///   4. proximal points from the best iterate, with two other ρ in turn, and the interior-point method for
///      convex problems in which |u_t| is a number, a few times. Where the heavy lies on the light, first the
///      latter: in a jam, impulses may be 1e8 times what comes in;
///   5. the interior-point method from several starts, |u_t| being what it is; whenever its gap fell a
///      thousand times, Newton's method from there; and more proximal points;
///   6. unless the caller would rather do without: all of this without friction, and again with more and more
///      of it, each time from the last answer.
///
/// Small enough: residual ≤ 1e-9 V, and ≤ max(1e-13 V, 1e-6 of the largest λ/mass): without the second
/// condition impulses of 1e-8 V can pass where the answer is large. Below the rounding error of the relative
/// velocities themselves it is always small enough, and so is what the caller calls enough where impulses are
/// 1000 times larger: every stage stops there. What else is accepted is then improved as far as a few steps
/// do.
///
/// Redundant contacts share evenly: the impulses are nearest to the warm start, or to zero, or central. Where
/// a problem has several answers (friction can have that), this order chooses, and nothing that depends on
/// names.
///
/// Contacts with a choice of directions are left out at first, and added where the velocities without them
/// are against all of theirs by more than the residual; then their normal is that of the rows
/// (solveWithTakingPart).
///
/// An object keeps the order of elimination and its memory while bodies and contacts touch each other as
/// before.
class ContactSolver {
 public:
  /// `solution.impulses` is the warm start if there is one for each contact. Gives up, with the best iterate,
  /// after about `mostFactorisations`; problems without a solution take all of them.
  bool solve(const ContactProblem& problem, ContactSolution& solution, int mostFactorisations = kMost);
  static constexpr int kMost = 3000;
  /// The same without stage 6, for contacts without a choice.
  bool solveOnce(const ContactProblem& problem, ContactSolution& solution, int mostFactorisations);
  /// Of all problems that were solved since it was last asked.
  ContactResiduals takeResiduals() { return std::exchange(residuals_, {}); }

 private:
  using Triple = ContactProblem::Triple;

  bool solveWithAll(const ContactProblem& problem, ContactSolution& solution, int mostFactorisations);
  bool raiseFriction(const ContactProblem& problem, ContactSolution& solution, int mostFactorisations);
  void solveWithoutPolish(const ContactSolution& solution);
  bool tryNewton(std::span<const Triple> from, ContactNewton::Options options);
  bool tryApproach(std::span<const Triple> from, ContactNewton::Options options);
  bool tryInterior(const InteriorPoint::Options& options, int iterations, std::span<const double> slips);
  bool tryConvex();
  bool trySticking(double epsilon, int steps);
  bool tryStanding();
  bool stands() const;
  bool hasFriction() const;
  bool trySets();
  void forget();
  ContactResiduals residuals() const;
  bool tryProximal(int rounds);
  void polish();
  bool keepIfBetter(double residual);
  bool isEnough() const;
  bool mayGoOn() const { return factorisations_ < most_; }
  double inScale(double part) const { return part * contacts_.scale(); }

  CoupledContacts contacts_;
  ContactNewton newton_;
  InteriorPoint interior_;
  std::vector<Triple> impulses_;  // the best
  std::vector<double> q_;
  double residual_ = 0;
  double enough_ = 0;
  std::vector<Triple> trial_;
  std::vector<double> trialQ_;
  std::vector<Triple> from_;
  int factorisations_ = 0;
  int most_ = kMost;
  ContactResiduals residuals_;
};

}  // namespace careen
