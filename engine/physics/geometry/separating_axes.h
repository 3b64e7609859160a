#pragma once

#include <span>
#include <vector>

#include "core/math/linear_algebra.h"
#include "physics/geometry/box_at.h"
#include "physics/geometry/separation.h"

namespace careen {

/// A set of BoxAxis: axis k is bit k.
using AxisSet = unsigned;
inline constexpr AxisSet kAllAxes = (1U << BoxAxis::kCount) - 1;
inline bool contains(AxisSet set, int axis) { return (set >> axis & 1U) != 0; }
/// The same axes with a and b in each other's place.
AxisSet swapped(AxisSet set);

/// The axes along which two boxes are as good as apart: those of a separation of at most `within` [m] less
/// than the largest, or than none where they are apart. Empty if their normals do not differ: then there is
/// nothing to choose.
///
/// Boxes do not enter each other as long as they stay apart along *one* of their axes. So where there are
/// several, a relative velocity u at the contact is allowed if n·u ≥ 0 for at least one of their directions
/// n: a union of half-spaces, and not the half-space of one mean normal. Such a contact takes part only where
/// the motion without it would enter along all of them (addEntering): a cube that slides over the joint of
/// two slabs does not strike the second one's edge, and diagonal neighbours in a wall carry nothing.
AxisSet separatingAxes(const BoxAt& a, const BoxAt& b, double within);
AxisSet separatingAxes(const BoxAt& a, const BoxAt& b, const BoxAxes& axes, double within);

/// [1] Their directions as the boxes are now: unit, from b to a.
std::vector<Vec3> directionsOf(AxisSet set, const BoxAt& a, const BoxAt& b);

/// Of separatingAxes(), those that are not approached faster than `slow` [m/s] if they are one direction:
/// that is the normal then, and there is nothing to choose. Else all of them. `velocity` [m/s]: of a relative
/// to b at the contact.
AxisSet withoutApproached(AxisSet set, const BoxAt& a, const BoxAt& b, const Vec3& velocity, double slow);

/// [m/s] How fast boxes part along the best of these directions, given a's velocity relative to b's at the
/// contact: the rate of their gap.
double partingSpeed(std::span<const Vec3> directions, const Vec3& velocity);

}  // namespace careen
