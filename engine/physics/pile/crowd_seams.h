#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "physics/motion/joined_steps.h"
#include "physics/pile/crowd_contacts.h"
#include "physics/pile/crowd_members.h"
#include "physics/pile/crowd_memory.h"

namespace careen {

/// Whether the path of a crowd may be smooth where one step joins the next.
class CrowdSeams {
 public:
  CrowdSeams(const CrowdMembers& members, CrowdContacts& contacts, CrowdMemory& memory)
      : members_(members), contacts_(contacts), memory_(memory) {}

  /// A step begins: of the one before, what the next seam asks for.
  void remember();
  /// Whether near where the step begins, the smooth path through both would lead members deep into each
  /// other: then its begin is to be met.
  bool isSharp();

 private:
  using Rates = CrowdMemory::Rates;
  Rates meanRates(std::size_t place) const;
  const Rates& ratesBefore(std::size_t place) const { return memory_.places[place].rates; }
  double pastOf(std::size_t place) const { return std::min(memory_.places[place].past, memory_.length); }
  Pose onPath(std::size_t place, const JoinedSteps::Beside& moment) const;
  double gapAt(const PileManifold& manifold, double along) const;
  double passingSpeed(const PileManifold& manifold) const;
  bool areAlike(const PileManifold& manifold) const;
  double bendOf(const PileManifold& manifold) const;
  bool staysApart(const PileManifold& manifold) const;
  bool isSharpAt(const PileManifold& manifold) const;

  const CrowdMembers& members_;
  CrowdContacts& contacts_;
  CrowdMemory& memory_;
  std::vector<Rates> change_;  // by place
};

}  // namespace careen
