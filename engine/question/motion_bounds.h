#pragma once

#include "core/math/linear_algebra.h"
#include "physics/motion/motion.h"
#include "physics/world/body.h"

namespace careen {

/// Upper bounds of how fast a value changes, and of how fast that does, per second; infinite where unknown.
struct RateBounds {
  double rate = 0;
  double bend = 0;
};

/// Upper bounds of a body's motion from one time of a segment to another.
struct MotionBounds {
  RateBounds place;     ///< of the centre of mass, |d/dt| [m/s] and |d²/dt²| [m/s²]
  double speed = 0;     ///< [m/s] its largest, as states tell it
  RateBounds velocity;  ///< of it
  double spin = 0;      ///< [rad/s] the largest |ω|, as states tell it, and by which the attitude turns
  RateBounds angularVelocity;  ///< of ω
};

/// `from` and `to` [s] are since the segment began. Of motions in steps of a study method, which are exact at
/// none of these times, they hold as closely as its steps do.
MotionBounds boundsOf(const Motion& motion, const MassProperties& mass, double from, double to);

/// The same of the place of the centre of mass along a unit direction alone.
RateBounds boundsAlong(const Motion& motion, const Vec3& direction, double from, double to);

}  // namespace careen
