#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace careen {

// The only place that spells out Eigen's types. Columns; right-handed; SI units.
template <class Real>
using Vector3 = Eigen::Matrix<Real, 3, 1>;
template <class Real>
using Matrix3 = Eigen::Matrix<Real, 3, 3>;
/// Constructed as (w, x, y, z), but coeffs() is x, y, z, w: use the named fields.
template <class Real>
using Quaternion = Eigen::Quaternion<Real>;

using Vec3 = Vector3<double>;
using Mat3 = Matrix3<double>;
using Quat = Quaternion<double>;

}  // namespace careen
