#pragma once

#include <string>
#include <vector>

#include "stage/run_setup.h"

namespace careen {

struct MjcfFile {
  std::string text;
  std::vector<std::string> leftOut;  ///< what MJCF cannot say, in words; also a comment in the file
};

/// What a run starts from as MJCF, the XML format of MuJoCo (2.2 and later): walls as planes, boxes with
/// their masses, inertias and colours, each in the one that holds it (exchange/mjcf_tree.h), joints
/// (exchange/export_mjcf_joints.h), springs as tendons, and a key frame "start" with all poses and
/// velocities. A body of several boxes has a geom for each. Friction of each pair is sqrt(μ₁ μ₂), stated pair
/// by pair where the boxes and walls differ. MJCF has no coefficient of restitution, and drag only if linear
/// and angular drag are the same number and nothing is jointed. InputError beyond kMostMjcfPairs pairs.
MjcfFile encodeMjcf(const RunSetup& setup, const std::string& program);
inline constexpr std::size_t kMostMjcfPairs = 100'000;

}  // namespace careen
