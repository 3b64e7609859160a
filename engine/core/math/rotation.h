#pragma once

#include "core/math/linear_algebra.h"

namespace careen {

/// ω̃ with ω̃ r = ω × r (Eq. 9).
Mat3 tilde(const Vec3& omega);

/// A matrix B in body space, transformed to the space that A maps to: A B Aᵀ (Eq. 2).
Mat3 similarityTransform(const Mat3& a, const Mat3& b);

/// Rate of an orientation that rotates with ω [rad/s], world frame: ω̃ A (Eq. 10).
Mat3 orientationRate(const Vec3& omega, const Mat3& worldFromBody);

/// Gram–Schmidt from column 0: its direction is kept, column 1 is made perpendicular to it, and column 2 is
/// their cross product, so that det = +1. This is the choice of the 1997 sample; the order of the columns
/// determines how its energy drifts. Columns 0 and 1 must not be parallel.
Mat3 orthonormalizeFromColumn0(const Mat3& a);

/// ‖AAᵀ − 1‖ (Frobenius): 0 for a special orthogonal matrix (Eq. 1).
double orthogonalityError(const Mat3& a);

}  // namespace careen
