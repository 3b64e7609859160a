#pragma once

#include <vector>

#include "core/disjoint_sets.h"
#include "physics/pile/crowd_articulations.h"
#include "physics/pile/crowd_contacts.h"
#include "physics/pile/crowd_loads.h"
#include "physics/pile/crowd_members.h"
#include "physics/pile/crowd_memory.h"
#include "physics/pile/solver.h"

namespace careen {

/// Sleep of a crowd's members: with all that they touch, or, where some of that still moves, beyond a few
/// contacts from it, if forces within their cones balance on them at rest, those of the ones awake being as
/// they are: then until what the ones awake push them with changes by an eighth of that and their weight.
class CrowdSleep {
 public:
  CrowdSleep(CrowdMembers& members, const CrowdLoads& loads, CrowdContacts& contacts,
             const CrowdArticulations& articulations, CrowdMemory& memory);

  /// Those that the last step pushed otherwise than when they fell asleep: at the start of the next one, as
  /// they did not move in it. And those whose joints may change.
  void wakeDisturbed();
  /// Those that contacts would push by more than they tolerate; returns whether there are any: their pairs
  /// are to be looked at, too.
  bool wakePushed();
  /// What an impulse of this step went through as if it were a wall; returns whether there is any: the step
  /// is to be solved anew.
  bool wakeStruck(const PileSolver& solver);
  /// Who was woken has been seen to.
  void forgetWoken();
  /// With the impulses of the step kept: whom to wake before the next.
  void findDisturbed();

  /// A cluster in contact falls asleep if, with all velocities set to zero, gravity and the last impulses
  /// nearly balance on every body: then it would not move, and these impulses, which lie in their friction
  /// cones, hold it indefinitely. Motion at constant speed passes that test too, so the speed must also be
  /// one that friction can stop within the step, μ g h. Of a cluster that does not, parts. Returns whether
  /// all sleep.
  bool freeze();

 private:
  void wakeCluster(int cluster);
  void wakeNeighbours();
  bool wouldPush(const PilePair& pair) const;
  bool isHalfAsleep(const PileManifold& manifold) const;
  const PileBody& sleeperOf(const PileManifold& manifold) const;
  bool changes(const PileManifold& manifold, const Vec3& force, const Vec3& carried, double times) const;
  void findClusters();
  void joinArticulations();
  bool isQuiet(std::size_t place, double imbalance, double part) const;
  void freeze(std::size_t place, int cluster);
  void freezeParts();
  void keepFar(std::vector<char>& marked) const;
  void certify(std::vector<char>& chosen);
  void pushWithLast(const PileManifold& manifold, int body);
  void restoreImpulses(const std::vector<int>& slots, const std::vector<char>& sleeping);

  CrowdMembers& members_;
  const CrowdLoads& loads_;
  CrowdContacts& contacts_;
  const CrowdArticulations& articulations_;
  CrowdMemory& memory_;
  PileSolver solver_;            // of certificates
  std::vector<double> grip_;     // [1] largest friction coefficient at a body's contacts
  std::vector<char> isCarried_;  // by place: it touches something driven, or gravity slopes
  DisjointSets clusters_;        // of bodies in resting contact
  std::vector<char> woken_;      // by place: in this step
};

}  // namespace careen
