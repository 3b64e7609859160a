#pragma once

#include <span>
#include <vector>

#include "core/math/pose_difference.h"
#include "physics/world/world.h"

namespace careen {

/// Distance of two sets of states of the same world: the largest of its movable bodies.
PoseDifference differenceOf(const World& world, std::span<const BodyState> a, std::span<const BodyState> b);

/// Bodies at these poses, at rest.
std::vector<BodyState> withPoses(std::span<const Pose> poses);

}  // namespace careen
