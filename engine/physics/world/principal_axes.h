#pragma once

#include "core/math/linear_algebra.h"

namespace careen {

struct PrincipalAxes {
  Vec3 moments = Vec3::Zero();   ///< of the tensor's unit
  Mat3 axes = Mat3::Identity();  ///< [1] a rotation: column k is the axis of moments[k]
};

/// tensor = axes · diag(moments) · axesᵀ, of a symmetric tensor, whose upper triangle is read. By Jacobi's
/// rotations (1846; here in the form of Golub & Van Loan, "Matrix Computations", 8.5): products and square
/// roots only, so the same bits everywhere; backward stable, with moments to a few roundings of the largest.
/// Each rotation is the smaller of the two that remove a part, so axes stay nearest to those of the tensor's
/// frame.
PrincipalAxes principalAxes(const Mat3& tensor);

}  // namespace careen
