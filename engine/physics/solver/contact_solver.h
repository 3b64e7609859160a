#pragma once

#include <vector>

#include "physics/solver/contact_newton.h"
#include "physics/solver/contact_problem.h"
#include "physics/solver/coupled_contacts.h"
#include "physics/solver/interior_point.h"

namespace careen {

/// Solves a ContactProblem, or says honestly that it did not. In this order, until the residual is small enough:
///
///   1. Newton's method from the warm start, or with every contact closed and sticking at first;
///   2. the interior-point method; whenever its gap fell 100 times, Newton's method from there;
///   3. the interior-point method from other starts, with other parameters.
///
/// Small enough: residual ≤ 1e-9 V and ≤ max(1e-13 V, 1e-6 of the largest λ/mass). Without the second condition impulses of
/// 1e-8 V can pass where the answer is large. What is accepted is improved as far as rounding errors allow.
///
/// An object keeps the order of elimination and its memory while bodies and contacts touch each other as before.
class ContactSolver {
 public:
  bool solve(const ContactProblem& problem, ContactSolution& solution);

 private:
  using Triple = ContactProblem::Triple;

  bool tryNewton(std::span<const Triple> from, const ContactNewton::Options& options);
  bool tryInterior(const InteriorPoint::Options& options, int iterations);
  bool keepIfBetter(double residual);
  bool isEnough() const;
  void polish();
  void search();

  CoupledContacts contacts_;
  ContactNewton newton_;
  InteriorPoint interior_;
  std::vector<Triple> impulses_;  // the best
  std::vector<double> q_;
  double residual_ = 0;
  double enough_ = 0;
  std::vector<Triple> trial_;
  std::vector<double> trialQ_;
  int factorisations_ = 0;
};

}  // namespace careen
