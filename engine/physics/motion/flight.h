#pragma once

#include "core/math/linear_algebra.h"

namespace careen {

/// Free flight: constant acceleration, no torque. Closed form at any time, however long it lasts: the centre
/// of mass follows a parabola, the attitude is that of the torque-free top.
struct Flight {
  Vec3 position = Vec3::Zero();           ///< [m] of the centre of mass at its start, world
  Vec3 velocity = Vec3::Zero();           ///< [m/s] likewise
  Vec3 acceleration = Vec3::Zero();       ///< [m/s²]
  Quat worldFromBody = Quat::Identity();  ///< at its start
  Vec3 angularMomentum = Vec3::Zero();    ///< [kg m²/s] constant

  Vec3 positionAt(double elapsed) const {
    return position + (velocity + 0.5 * elapsed * acceleration) * elapsed;
  }
  Vec3 velocityAt(double elapsed) const { return velocity + elapsed * acceleration; }
};

}  // namespace careen
