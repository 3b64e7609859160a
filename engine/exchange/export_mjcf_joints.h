#pragma once

#include <string>
#include <vector>

#include "exchange/mjcf_tree.h"

namespace careen {

/// What MJCF says of the joints of a world, beside the tree of its bodies: elements by section.
struct MjcfJoints {
  std::vector<std::string> ofBody;  ///< <joint> by body; empty if it is free, fixed, or one with its parent
  std::vector<std::string> tendons;
  std::vector<std::string> equalities;
  std::vector<std::string> actuators;
  std::vector<std::string> excludes;
  std::string places;                ///< qpos at the start
  std::string speeds;                ///< qvel
  std::vector<std::string> leftOut;  ///< in words
};

MjcfJoints encodeJoints(const World& world, const MjcfTree& tree);

/// [m] A point in the frame of the body's box, given in the body's.
Vec3 inBoxFrame(const Body& body, const Vec3& point);

/// The name of an end of a spring or joint.
std::string mjcfSite(const std::string& kind, std::size_t index, const char* end);

}  // namespace careen
