#pragma once

#include "core/math/linear_algebra.h"

namespace careen {

/// Cosine and sine of an angle.
struct Turn {
  double cosine = 1;
  double sine = 0;
};

/// Error at most 2e-16, exact at multiples of 90°. Uses no libm function that rounds: their last bits depend
/// on the processor, and a scene must not.
Turn turnFrom(double degrees);

/// Eq. 6 as a matrix: rotation of a vector about a unit axis.
Mat3 rotationAbout(const Vec3& unitAxis, const Turn& turn);

}  // namespace careen
