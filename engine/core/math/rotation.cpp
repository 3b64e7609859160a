#include "core/math/rotation.h"

namespace careen {

Mat3 tilde(const Vec3& omega) {
  Mat3 m;
  m << 0, -omega.z(), omega.y(),  //
      omega.z(), 0, -omega.x(),   //
      -omega.y(), omega.x(), 0;
  return m;
}

Mat3 similarityTransform(const Mat3& a, const Mat3& b) { return a * b * a.transpose(); }

Mat3 orientationRate(const Vec3& omega, const Mat3& worldFromBody) { return tilde(omega) * worldFromBody; }

Mat3 orthonormalizeFromColumn0(const Mat3& a) {
  Mat3 result;
  const Vec3 x = a.col(0).normalized();
  const Vec3 y = (a.col(1) - dot(x, a.col(1)) * x).normalized();
  result << x, y, x.cross(y);
  return result;
}

double orthogonalityError(const Mat3& a) { return (a * a.transpose() - Mat3::Identity()).norm(); }

}  // namespace careen
