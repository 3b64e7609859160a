#pragma once

#include <cstddef>
#include <vector>

#include "physics/pile/crowd_contacts.h"
#include "physics/pile/crowd_members.h"

namespace careen {

/// How deep members of a crowd are in each other: at the end of a step and on the way there.
class CrowdDepth {
 public:
  static constexpr double kDeep = 1.5;  ///< [1] of the tolerance: new penetration that is projected at once

  CrowdDepth(const CrowdMembers& members, CrowdContacts& contacts) : members_(members), contacts_(contacts) {}

  /// [m] How deep bodies went into each other in this step, if more than kDeep: the features
  /// of the manifolds of its start were not all that met. Says of each pair whether it is deep.
  double find();
  /// Whether that pair went deep, or is very deep, even if it was before; and whether any did.
  bool isDeep(std::size_t pair) const { return isDeep_[pair] != 0; }
  bool anyIsDeep() const;
  /// [m] The deepest of the others.
  double undone() const { return undone_; }

  /// Before what follows is asked of bodies that moved otherwise since.
  void findTurns();
  /// [m] By all axes; and at the start of the step.
  double overlap(const PilePair& pair) const { return overlap(pair, members_.bodies); }
  double before(const PilePair& pair) const { return overlap(pair, members_.start); }
  /// [m] The same after a step, 0 if it cannot be or is not more than kDeep.
  double now(const PilePair& pair) const;
  /// [m] Overlap of two boxes within the step, if more than kDeep; into half-spaces they are deepest at its
  /// ends.
  double onWay(const PilePair& pair) const;
  /// [m] At the start of the step, of those that are deep now.
  double deepestBefore() const;

 private:
  double overlap(const PilePair& pair, const std::vector<PileBody>& bodies) const;
  double wayOf(int b, int a) const;
  double gapAtEnd(const PilePair& pair) const;
  bool staysApart(const PilePair& pair) const;
  double within(const PilePair& pair, double atEnd) const;
  bool startedDeep(const PilePair& pair) const;

  const CrowdMembers& members_;
  CrowdContacts& contacts_;
  std::vector<Vec3> turns_;   // [rad] by place, in the step
  std::vector<char> isDeep_;  // by pair
  double undone_ = 0;         // [m]
};

}  // namespace careen
