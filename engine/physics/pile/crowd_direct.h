#pragma once

#include <cstddef>
#include <vector>

#include "physics/pile/crowd_contacts.h"
#include "physics/pile/crowd_members.h"
#include "physics/pile/crowd_memory.h"
#include "physics/pile/solver.h"
#include "physics/solver/contact_solver.h"

namespace careen {

/// Direct solution of small crowds: by the solver of exact contact.
class CrowdDirect {
 public:
  static constexpr std::size_t kFewRows = 150;  ///< up to which they are always solved directly

  CrowdDirect(const CrowdMembers& members, const CrowdContacts& contacts, CrowdMemory& memory)
      : members_(members), contacts_(contacts), memory_(memory) {}

  /// Solves its rows for the impulses of which friction and complementarity hold to a verified residual;
  /// false, and nothing changed, where there are too many or none were found.
  bool solve(PileSolver& solver);
  ContactResiduals takeResiduals() { return solver_.takeResiduals(); }

 private:
  bool isHeavy() const;
  std::vector<std::size_t> pose(const PileSolver& solver);
  void addImpulses(double sign);

  const CrowdMembers& members_;
  const CrowdContacts& contacts_;
  CrowdMemory& memory_;
  ContactProblem problem_;
  ContactSolution solution_;
  ContactSolver solver_;
};

}  // namespace careen
