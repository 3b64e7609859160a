#pragma once

#include <cstddef>

#include "physics/pile/crowd_articulations.h"
#include "physics/pile/crowd_contacts.h"
#include "physics/pile/crowd_members.h"
#include "physics/pile/crowd_memory.h"
#include "physics/pile/crowd_problem.h"
#include "physics/pile/solver.h"
#include "physics/solver/contact_solver.h"

namespace careen {

/// Direct solution of small crowds, and of joints: by the solver of exact contact.
class CrowdDirect {
 public:
  static constexpr std::size_t kFewRows = 150;  ///< up to which they are always solved directly

  CrowdDirect(const CrowdMembers& members, const CrowdContacts& contacts, CrowdArticulations& articulations,
              CrowdMemory& memory)
      : members_(members),
        contacts_(contacts),
        articulations_(articulations),
        memory_(memory),
        problem_(members) {}

  /// Solves its rows and joints for the impulses of which friction and complementarity hold to a verified
  /// residual; false, and nothing changed, where there are too many or none were found.
  bool solve(PileSolver& solver);
  /// The joints alone, the impulses of its rows being as they are. Returns by how much [m/s] velocities of
  /// points change, at the most.
  double solveJoints(PileSolver& solver);
  ContactResiduals takeResiduals() { return solver_.takeResiduals(); }

 private:
  bool isHeavy() const;
  double enough() const;
  bool isBelt(int body) const;
  Vec3 beltAt(const PileSolver& solver, int body, const Vec3& arm) const;
  void addRows(const PileSolver& solver);
  void takeJoints(PileSolver& solver, std::size_t first);

  const CrowdMembers& members_;
  const CrowdContacts& contacts_;
  CrowdArticulations& articulations_;
  CrowdMemory& memory_;
  CrowdProblem problem_;
  ContactSolver solver_;
  ContactSolver ofJoints_;
};

}  // namespace careen
