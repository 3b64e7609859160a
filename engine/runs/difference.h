#pragma once

#include <span>
#include <vector>

#include "core/math/pose_difference.h"
#include "physics/world/world.h"

namespace careen {

/// Distance of two sets of states of the same world: the largest of its movable bodies.
PoseDifference differenceOf(const World& world, std::span<const BodyState> a, std::span<const BodyState> b);

/// [m] The largest distance of a point of a movable body in `a` from the same point in `b`, at most:
/// |Δx| + 2 R sin(angle/2), R the half diagonal. Infinite if a number is not finite.
double displacementOf(const World& world, std::span<const BodyState> a, std::span<const BodyState> b);

/// Bodies whose boxes have these poses, at rest.
std::vector<BodyState> withPoses(const World& world, std::span<const Pose> boxes);

}  // namespace careen
