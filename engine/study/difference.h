#pragma once

#include <span>
#include <vector>

#include "core/math/pose_difference.h"
#include "physics/world/world.h"

namespace careen {

/// How far two sets of states of the same world lie apart: the worst of its bodies that can move.
PoseDifference differenceOf(const World& world, std::span<const BodyState> a, std::span<const BodyState> b);

/// Bodies at these poses, still.
std::vector<BodyState> withPoses(std::span<const Pose> poses);

}  // namespace careen
