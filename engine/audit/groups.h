#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "audit/samples.h"
#include "trajectory/trajectory.h"

namespace careen {

/// Bodies that may exchange momentum during a run: joined by impacts, springs, joints or contact. Every
/// movable body is in one group; immovable bodies are in none, they act like walls.
struct ExchangeGroup {
  std::vector<std::size_t> bodies;       ///< ascending
  std::vector<std::size_t> springs;      ///< with at least one end on a body of the group
  std::vector<std::size_t> joints = {};  ///< likewise
  std::vector<std::size_t> impacts;      ///< on bodies of the group, in order of time
  bool mayLose = false;                  ///< some contact of its bodies has e < 1 or friction
  bool jointsLose = false;               ///< some limit or rope of its joints has e < 1

  bool holds(std::size_t body) const { return std::binary_search(bodies.begin(), bodies.end(), body); }
};

std::vector<ExchangeGroup> exchangeGroups(const Trajectory& run, const Samples& samples);

/// [m] Boxes and walls that are no farther apart may touch.
double touchingDistance(const Body& body, const RunSettings& settings);

}  // namespace careen
