#pragma once

#include <vector>

#include "physics/pile/crowd_contacts.h"
#include "physics/pile/crowd_impulses.h"
#include "physics/pile/crowd_loads.h"
#include "physics/pile/crowd_members.h"
#include "physics/pile/crowd_memory.h"

namespace careen {

/// Restitution of a crowd, and its record.
class CrowdBounces {
 public:
  /// An impact of the last step: one contact point.
  struct Struck {
    int a = 0;  ///< place
    int b = 0;
    Vec3 point = Vec3::Zero();    ///< [m] world
    Vec3 normal = Vec3::UnitZ();  ///< [1] from b to a
    double approach = 0;          ///< [m/s]
    double impulse = 0;           ///< [N s]
    double tangential = 0;        ///< [N s]
  };

  CrowdBounces(CrowdMembers& members, const CrowdLoads& loads, CrowdContacts& contacts,
               const CrowdMemory& memory)
      : members_(members), loads_(loads), contacts_(contacts), memory_(memory) {}

  /// What strikes in the step, before it moves.
  void find();
  /// New impacts separate with e times their approach speed: a second solve after the motion, at the new
  /// positions (otherwise the angular momentum about each other is not conserved), starting from the impulses
  /// of the first. Its velocities are those of the end of the step, to which forces act on all that are
  /// pushed.
  void bounce(CrowdImpulses& impulses);
  const std::vector<Struck>& impacts() const { return impacts_; }
  /// There was no step.
  void clear() { impacts_.clear(); }

 private:
  struct Bounce {
    int row = 0;
    double speed = 0;     // [m/s] separation speed
    double approach = 0;  // [m/s]
    double fall = 0;      // [m/s] by which forces change the normal speed in the step
    int slot = 0;         // manifold
    int point = 0;        // of it
  };
  struct Energies {     // of bodies that bounce together
    double before = 0;  // [J] kinetic, at the start of the step, and what forces did in it
    double first = 0;   // after the first solve
    double second = 0;
    double change = 0;  // of the velocities that the second solve adds
  };
  void findOf(const PileManifold& manifold, int slot);
  void solve(CrowdImpulses& impulses);
  void limit(PileSolver& solver) const;
  void note(const PileSolver& solver);

  CrowdMembers& members_;
  const CrowdLoads& loads_;
  CrowdContacts& contacts_;
  const CrowdMemory& memory_;
  std::vector<Bounce> bounces_;
  std::vector<Struck> impacts_;
};

}  // namespace careen
