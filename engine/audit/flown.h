#pragma once

#include "core/math/linear_algebra.h"
#include "physics/world/body.h"

namespace careen {

/// State of a body that nothing touches, `seconds` after `from`, or before it: the centre of mass falls, and
/// the attitude follows from the angular momentum by fourth-order Runge–Kutta steps. What cannot move stays.
BodyState flown(const MassProperties& mass, const BodyState& from, const Vec3& gravity, double seconds);

/// [rad] Rotation vector from one attitude to another, world frame; less than half a turn.
Vec3 turnBetween(const Mat3& from, const Mat3& to);

/// [m/s] Velocity of the body's material point at `place` [m].
Vec3 velocityAt(const MassProperties& mass, const BodyState& state, const Vec3& place);

}  // namespace careen
