#pragma once

#include <span>
#include <vector>

#include "physics/solver/coupled_contacts.h"

namespace careen {

/// Newton's method on all contacts' equations (ContactEquation) at once, in three degrees of caution. Each
/// improves given impulses and returns the best residual [m/s] it met; `impulses` and `q` become those of the
/// best iterate, in their cones. Residual: the largest violation of a contact's law.
class ContactNewton {
 public:
  using Triple = ContactProblem::Triple;
  struct Options {
    double rho = 1;            ///< [1] ρ, in effective masses of each contact
    double epsilon = 0x1p-24;  ///< [1] ε
    int steps = 10;            ///< at most so many factorisations
    double enough = 0;         ///< [m/s] residual at which to stop
  };

  /// Full steps, each centred at the last iterate; gives up after three in a row that do not halve the
  /// residual. `sticking`: the first step takes every contact as closed and sticking.
  double improve(CoupledContacts& contacts, std::span<Triple> impulses, std::span<double> q,
                 const Options& options, bool sticking = false);
  /// Shortened steps, with ε ever larger until the residual falls.
  double descend(CoupledContacts& contacts, std::span<Triple> impulses, std::span<double> q, Options options);
  /// Proximal points (R. T. Rockafellar, SIAM J. Control Optim. 14, 1976): each is a solution of the
  /// equations with ε, the next is centred there; ε follows the success. The residual need not fall: nearly
  /// redundant contacts have directions in which the impulses must go far before the residual changes.
  double approach(CoupledContacts& contacts, std::span<Triple> impulses, std::span<double> q,
                  Options options);

  /// Of the last call.
  int factorisations() const { return factorisations_; }
  /// Where approach() ended.
  std::span<const Triple> lastCentre() const { return centres_; }

  /// Residual [m/s] of these impulses with the velocities that follow from them.
  static double residual(const CoupledContacts& contacts, std::span<const Triple> impulses,
                         std::span<double> q);

 private:
  double begin(const CoupledContacts& contacts, std::span<const Triple> impulses, std::span<double> q);
  bool step(CoupledContacts& contacts, const Options& options, std::span<const Triple> centres,
            bool sticking);
  bool solveProximal(CoupledContacts& contacts, const Options& options, double error, int& steps);
  double fractionThatFalls(const CoupledContacts& contacts, std::span<const Triple> from, double best);
  double admit(const CoupledContacts& contacts);
  void keep(std::span<Triple> impulses, std::span<double> q) const;

  std::vector<Triple> impulses_;
  std::vector<Triple> centres_;
  std::vector<Triple> admissible_;
  std::vector<Triple> u_;
  std::vector<ContactAnswer> answers_;
  std::vector<double> q_;
  std::vector<double> dq_;
  int factorisations_ = 0;
};

}  // namespace careen
