#pragma once

#include <span>
#include <vector>

#include "physics/solver/coupled_contacts.h"

namespace careen {

/// Newton's method on all contacts' equations (ContactEquation) at once. Both ways improve given impulses and
/// return the best residual [m/s] they met; `impulses` and `q` become those of the best iterate, in their
/// cones. Residual: the largest violation of a contact's law.
class ContactNewton {
 public:
  using Triple = ContactProblem::Triple;
  struct Options {
    double rho = 1;            ///< [1] ρ, in effective masses of each contact
    double epsilon = 0x1p-24;  ///< [1] ε
    int steps = 10;            ///< at most so many factorisations
    int patience = 30;         ///< approach() ends after so many of them that did not halve the residual
    double enough = 0;         ///< [m/s] residual at which to stop
    double good = 0;           ///< [m/s] the same, if it is small against the impulses, see isGood()
    bool sticking = false;     ///< improve() takes every contact as closed and sticking in the first step
  };

  /// Full steps, each centred at the last iterate; gives up after three in a row that do not halve the
  /// residual.
  double improve(CoupledContacts& contacts, std::span<Triple> impulses, std::span<double> q,
                 const Options& options);
  /// Proximal points (R. T. Rockafellar, SIAM J. Control Optim. 14, 1976): each solves the equations with ε
  /// more or less, the next is centred there; ε follows the success. The residual need not fall: nearly
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
  /// Whether such a residual of these impulses is at most `good`, and not a ghost: a small residual where
  /// impulses that are as small were to be found.
  static bool isGood(const CoupledContacts& contacts, std::span<const Triple> impulses, double residual,
                     double good);

 private:
  double begin(const CoupledContacts& contacts, std::span<Triple> impulses, std::span<double> q);
  enum class Modes { kOfImpulses, kSticking };
  bool step(CoupledContacts& contacts, const Options& options, std::span<const Triple> centres, Modes modes);
  void follow(const CoupledContacts& contacts);
  double equationsError(const CoupledContacts& contacts, const Options& options) const;
  bool solveProximal(CoupledContacts& contacts, const Options& options, double error, int& steps);
  double admit(const CoupledContacts& contacts);
  void keep(std::span<Triple> impulses, std::span<double> q) const;

  std::vector<Triple> impulses_;
  std::vector<Triple> centres_;
  std::vector<Triple> admissible_;
  std::vector<double> admissibleQ_;
  std::vector<ContactAnswer> answers_;
  std::vector<double> q_;  // of impulses_, like u_
  std::vector<Triple> u_;
  std::vector<double> dq_;
  int factorisations_ = 0;
};

}  // namespace careen
