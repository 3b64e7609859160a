#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "physics/world/world.h"

namespace careen {

/// The bodies of a world, one in another: each that a joint of the tree holds is in what holds it. Fixed ones
/// and the world are one root, bodies that nothing holds are others.
struct MjcfTree {
  std::vector<std::optional<int>> parent;         ///< the body that it is in, by body; none: the world
  std::vector<std::optional<std::size_t>> joint;  ///< that holds it there
  std::vector<int> order;                         ///< of all bodies: MuJoCo's
  std::vector<std::size_t> closing;  ///< joints that close loops or long chains, but rods and ropes
  /// The first body of those that it is one with, since only fixed joints are between them; none: the world.
  std::vector<std::optional<int>> oneWith;

  bool isFree(const World& world, int body) const {
    const auto index = static_cast<std::size_t>(body);
    return !joint[index] && !isImmovable(world.bodies[index].mass);
  }
  /// Whether MuJoCo lets two bodies through each other, since they are one, or one is in the other.
  bool areJoined(int a, int b) const;
};

/// Joints are in it before others if nothing but a joint of the tree can say what they do: sliders, hinges
/// with limits, springs or motors, fixed ones, and other hinges before balls. Bodies are in one another as
/// deep as kDeepestXml lets them; what goes on there is another tree.
MjcfTree treeOf(const World& world);

}  // namespace careen
