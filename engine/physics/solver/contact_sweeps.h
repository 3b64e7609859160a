#pragma once

#include <span>
#include <vector>

#include "physics/solver/coupled_contacts.h"

namespace careen {

/// Gauss–Seidel over the contacts, each projected onto its law in turn (M. Jean, Comput. Methods Appl. Mech.
/// Eng. 177, 1999). It converges slowly, but gets away from where other methods are stuck.
class ContactSweeps {
 public:
  using Triple = ContactProblem::Triple;

  void start(const CoupledContacts& contacts, std::span<const Triple> impulses);
  /// Returns false if the impulses diverge, as they can where friction has a given direction.
  bool sweep(const CoupledContacts& contacts, int times);
  std::span<const Triple> impulses() const { return impulses_; }

 private:
  std::vector<Triple> impulses_;
  std::vector<double> q_;
};

}  // namespace careen
