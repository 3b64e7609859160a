#pragma once

#include "core/math/linear_algebra.h"

namespace careen {

/// Free flight: an acceleration that is constant or grows evenly, no torque. Closed form at any time, however
/// long it lasts: the centre of mass follows a parabola or a cubic, the attitude is that of the torque-free
/// top.
struct Flight {
  Vec3 position = Vec3::Zero();           ///< [m] of the centre of mass at its start, world
  Vec3 velocity = Vec3::Zero();           ///< [m/s] likewise
  Vec3 acceleration = Vec3::Zero();       ///< [m/s²] likewise
  Quat worldFromBody = Quat::Identity();  ///< at its start
  Vec3 angularMomentum = Vec3::Zero();    ///< [kg m²/s] constant
  Vec3 jerk = Vec3::Zero();               ///< [m/s³] constant

  Vec3 positionAt(double elapsed) const {
    return position + (velocity + 0.5 * elapsed * acceleration + (elapsed * elapsed / 6) * jerk) * elapsed;
  }
  Vec3 velocityAt(double elapsed) const {
    return velocity + elapsed * acceleration + (0.5 * elapsed * elapsed) * jerk;
  }
  Vec3 accelerationAt(double elapsed) const { return acceleration + elapsed * jerk; }
};

}  // namespace careen
