#pragma once

#include <vector>

#include "physics/pile/crowd_articulations.h"
#include "physics/pile/crowd_contacts.h"
#include "physics/pile/crowd_impulses.h"
#include "physics/pile/crowd_loads.h"
#include "physics/pile/crowd_members.h"
#include "physics/pile/crowd_memory.h"
#include "physics/pile/crowd_restitution.h"

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
               CrowdArticulations& articulations, const CrowdMemory& memory)
      : members_(members),
        loads_(loads),
        contacts_(contacts),
        articulations_(articulations),
        memory_(memory),
        restitution_(members, contacts) {}

  /// What strikes in the step, before it moves.
  void find();
  /// What strikes, and what impulses reach from there, parts as the law says (CrowdRestitution): a second
  /// solve after the motion, at the new positions (otherwise the angular momentum about each other is not
  /// conserved), in which friction opposes the slip without what restitution adds. Its velocities are those
  /// of the end of the step, to which forces act on all that are pushed.
  void bounce(CrowdImpulses& impulses);
  const std::vector<Struck>& impacts() const { return impacts_; }
  /// There was no step.
  void clear() { impacts_.clear(); }

 private:
  struct Bounce {
    double approach = 0;  // [m/s]
    int slot = 0;         // manifold
    int point = 0;        // of it
  };
  struct Energies {      // [J] of bodies that bounce together
    double before = 0;   // at the start of the step, and what forces did in it
    double without = 0;  // kinetic, without what restitution adds
    double slope = 0;    // of a part of that, and of its square
    double change = 0;
    double taken = 0;  // by the law's impulses without what restitution adds
    double part() const;
  };
  void findOf(const PileManifold& manifold, int slot);
  Vec3 falling(int body) const;
  double fallOf(const PileManifold& manifold, int point) const;
  void findClosed();
  bool resolve();
  void solve(CrowdImpulses& impulses);
  void beginFrom(PileSolver& solver);
  void giveBack(PileSolver& solver) const;
  double workOfBelt(const ReachedPoint& point, const PileSolver& solver) const;
  double drivenSpeed(const ReachedPoint& point) const;
  void addEnergies(const ReachedBody& reached, const PileSolver& solver, Energies& all) const;
  void note(const PileSolver& solver);

  CrowdMembers& members_;
  const CrowdLoads& loads_;
  CrowdContacts& contacts_;
  CrowdArticulations& articulations_;
  const CrowdMemory& memory_;
  CrowdRestitution restitution_;
  std::vector<Bounce> bounces_;
  std::vector<Struck> impacts_;
};

}  // namespace careen
