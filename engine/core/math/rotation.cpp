#include "core/math/rotation.h"

#include <cmath>

namespace careen {

Mat3 tilde(const Vec3& omega) {
  Mat3 m;
  m << 0, -omega.z(), omega.y(),  //
      omega.z(), 0, -omega.x(),   //
      -omega.y(), omega.x(), 0;
  return m;
}

Mat3 similarityTransform(const Mat3& a, const Mat3& b) { return a * b * a.transpose(); }

AxisDecomposition decomposeAboutAxis(const Vec3& unitAxis, const Vec3& r) {
  const Vec3 along = unitAxis.dot(r) * unitAxis;
  return {.along = along, .radial = r - along, .ahead = unitAxis.cross(r)};
}

Vec3 rotateAboutAxis(const Vec3& unitAxis, double angle, const Vec3& r) {
  const AxisDecomposition parts = decomposeAboutAxis(unitAxis, r);
  return parts.along + std::cos(angle) * parts.radial + std::sin(angle) * parts.ahead;
}

Mat3 axisAngle(const Vec3& unitAxis, double angle) {
  const Mat3 along = unitAxis * unitAxis.transpose();
  return along + std::cos(angle) * (Mat3::Identity() - along) + std::sin(angle) * tilde(unitAxis);
}

Mat3 orientationRate(const Vec3& omega, const Mat3& worldFromBody) { return tilde(omega) * worldFromBody; }

Mat3 orthonormalizeFromColumn0(const Mat3& a) {
  Mat3 result;
  const Vec3 x = a.col(0).normalized();
  const Vec3 y = (a.col(1) - x.dot(a.col(1)) * x).normalized();
  result << x, y, x.cross(y);
  return result;
}

double orthogonalityError(const Mat3& a) { return (a * a.transpose() - Mat3::Identity()).norm(); }

}  // namespace careen
