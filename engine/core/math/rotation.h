#pragma once

#include "core/math/linear_algebra.h"

namespace careen {

/// ω̃ with ω̃ r = ω × r (Eq. 9).
Mat3 tilde(const Vec3& omega);

/// A matrix B in body space, transformed to the space that A maps to: A B Aᵀ (Eq. 2).
Mat3 similarityTransform(const Mat3& a, const Mat3& b);

/// Decomposition of r about a unit axis n: r = along + radial, and ahead = n × r completes the right-handed
/// frame in which r rotates (Eqs. 3–5).
struct AxisDecomposition {
  Vec3 along;   ///< o = (nᵀr) n
  Vec3 radial;  ///< x = r − o
  Vec3 ahead;   ///< y = n × r
};
AxisDecomposition decomposeAboutAxis(const Vec3& unitAxis, const Vec3& r);

/// r rotated about a unit axis by `angle` [rad] (Eq. 6).
Vec3 rotateAboutAxis(const Vec3& unitAxis, double angle, const Vec3& r);

/// The matrix of rotateAboutAxis: Eq. 6 with r factored out.
Mat3 axisAngle(const Vec3& unitAxis, double angle);

/// Rate of an orientation that rotates with ω [rad/s], world frame: ω̃ A (Eq. 10).
Mat3 orientationRate(const Vec3& omega, const Mat3& worldFromBody);

/// Gram–Schmidt from column 0: its direction is kept, column 1 is made perpendicular to it, and column 2 is
/// their cross product, so that det = +1. This is the choice of the 1997 sample; the order of the columns
/// determines how its energy drifts. Columns 0 and 1 must not be parallel.
Mat3 orthonormalizeFromColumn0(const Mat3& a);

/// ‖AAᵀ − 1‖ (Frobenius): 0 for a special orthogonal matrix (Eq. 1).
double orthogonalityError(const Mat3& a);

}  // namespace careen
