#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace careen {

// The only place that spells out Eigen's types. Column vectors; right-handed; SI units.
template <class Real>
using Vector3 = Eigen::Matrix<Real, 3, 1>;
template <class Real>
using Matrix3 = Eigen::Matrix<Real, 3, 3>;
template <class Real>
using Vector4 = Eigen::Matrix<Real, 4, 1>;
template <class Real>
using Matrix4 = Eigen::Matrix<Real, 4, 4>;
/// Constructed as (w, x, y, z), but coeffs() is x, y, z, w: use the named fields.
template <class Real>
using Quaternion = Eigen::Quaternion<Real>;

using Vec2 = Eigen::Vector2d;
using Vec3 = Vector3<double>;
using Mat3 = Matrix3<double>;
using Vec4 = Vector4<double>;  ///< homogeneous: x y z w
using Mat4 = Matrix4<double>;
using Quat = Quaternion<double>;

/// The dot product, for Eigen's own: that one adds its terms in another order from Eigen 5 on, and motion
/// must have the same bits with every version. Of three terms the first is added to the sum of the others.
template <class A, class B>
typename A::Scalar dot(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return a.cwiseProduct(b).sum();
}
template <class Real>
Real dot(const Quaternion<Real>& a, const Quaternion<Real>& b) {
  return dot(a.coeffs(), b.coeffs());
}

}  // namespace careen
