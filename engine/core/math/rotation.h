#pragma once

#include "core/math/linear_algebra.h"

namespace careen {

/// ω̃ with ω̃ r = ω × r (Eq. 9).
Mat3 tilde(const Vec3& omega);

/// A matrix B that acts in the body, seen from the space A maps to: A B Aᵀ (Eq. 2).
Mat3 similarityTransform(const Mat3& a, const Mat3& b);

/// r taken apart about a unit axis n: r = along + radial, and ahead = n × r completes the right-handed frame
/// in which r turns (Eqs. 3–5).
struct AxisDecomposition {
  Vec3 along;   ///< o = (nᵀr) n
  Vec3 radial;  ///< x = r − o
  Vec3 ahead;   ///< y = n × r
};
AxisDecomposition decomposeAboutAxis(const Vec3& unitAxis, const Vec3& r);

/// r turned about a unit axis by `angle` [rad] (Eq. 6).
Vec3 rotateAboutAxis(const Vec3& unitAxis, double angle, const Vec3& r);

/// The matrix that does what rotateAboutAxis does: Eq. 6 with r pulled out.
Mat3 axisAngle(const Vec3& unitAxis, double angle);

/// Rate of an orientation that turns with ω [rad/s], world frame: ω̃ A (Eq. 10).
Mat3 orientationRate(const Vec3& omega, const Mat3& worldFromBody);

/// Gram–Schmidt from column 0: its direction is kept, column 1 is made perpendicular to it, and column 2 is
/// their cross product, so that det = +1. The 1997 sample's choice; which column comes first decides how its
/// energy errs. Columns 0 and 1 must not be parallel.
Mat3 orthonormalizeFromColumn0(const Mat3& a);

/// ‖AAᵀ − 1‖ (Frobenius): 0 for a special orthogonal matrix (Eq. 1).
double orthogonalityError(const Mat3& a);

}  // namespace careen
