#pragma once

#include "core/math/linear_algebra.h"

namespace careen {

/// Cosine and sine of an angle.
struct Turn {
  double cosine = 1;
  double sine = 0;
};

/// Within 2e-16, exact at multiples of 90°. No libm function that rounds: those give other last bits on other
/// processors, and a scene must not.
Turn turnFrom(double degrees);

/// Eq. 6 as a matrix: what turns a vector about a unit axis.
Mat3 rotationAbout(const Vec3& unitAxis, const Turn& turn);

}  // namespace careen
