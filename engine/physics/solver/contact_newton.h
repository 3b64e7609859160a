#pragma once

#include <span>
#include <vector>

#include "physics/solver/coupled_contacts.h"

namespace careen {

/// Newton's method on the equations of Alart and Curnier (contact_cone.h), from given impulses. Keeps the best iterate.
class ContactNewton {
 public:
  using Triple = ContactProblem::Triple;
  struct Options {
    double rho = 1;               ///< [1] ρ, as a multiple of each contact's effective mass
    double epsilon = 0x1p-24;     ///< [1] ε
    int steps = 10;               ///< at most
    bool stickFirst = false;      ///< the first step takes every contact as closed and sticking
  };

  /// From `impulses`; they and `q` become those of the best iterate, with impulses in their cones. Returns its residual
  /// [m/s], at most `enough` if that was reached.
  double improve(CoupledContacts& contacts, std::span<Triple> impulses, std::span<double> q, const Options& options,
                 double enough);
  int factorisations() const { return factorisations_; }

  /// Largest violation [m/s] of these impulses, with the velocities that follow from them.
  static double residual(const CoupledContacts& contacts, std::span<const Triple> impulses, std::span<double> q);

 private:
  bool step(CoupledContacts& contacts, const Options& options, bool sticking);

  std::vector<Triple> impulses_;
  std::vector<Triple> admissible_;
  std::vector<Triple> u_;
  std::vector<ContactAnswer> answers_;
  std::vector<double> q_;
  std::vector<double> dq_;
  int factorisations_ = 0;
};

}  // namespace careen
