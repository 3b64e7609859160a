#include "physics/world/principal_axes.h"

#include <array>
#include <cmath>
#include <utility>

namespace careen {
namespace {

constexpr int kMostSweeps = 32;  // four or five suffice: it converges quadratically
constexpr std::array<std::pair<Eigen::Index, Eigen::Index>, 3> kPlanes{{{0, 1}, {0, 2}, {1, 2}}};

// Removes the part (p, q) by a rotation in that plane.
void rotate(Mat3& tensor, Mat3& axes, Eigen::Index p, Eigen::Index q) {
  const double part = tensor(p, q);
  if (part == 0) {
    return;
  }
  const double cotangent = (tensor(q, q) - tensor(p, p)) / (2 * part);  // of twice the angle
  const double tangent =
      (cotangent < 0 ? -1 : 1) / (std::fabs(cotangent) + std::sqrt(1 + cotangent * cotangent));
  const double cosine = 1 / std::sqrt(1 + tangent * tangent);
  Mat3 turn = Mat3::Identity();
  turn(p, p) = cosine;
  turn(q, q) = cosine;
  turn(p, q) = tangent * cosine;
  turn(q, p) = -tangent * cosine;
  tensor = turn.transpose() * tensor * turn;
  tensor(p, q) = 0;
  tensor(q, p) = 0;
  axes = axes * turn;
}

}  // namespace

PrincipalAxes principalAxes(const Mat3& tensor) {
  PrincipalAxes found;
  Mat3 left = tensor.selfadjointView<Eigen::Upper>();
  const double size = left.cwiseAbs().maxCoeff();
  if (!(size > 0)) {
    return found;
  }
  left /= size;  // squares of the smallest and the largest numbers leave the range
  const auto beside = [&left] {
    return std::fabs(left(0, 1)) + std::fabs(left(0, 2)) + std::fabs(left(1, 2));
  };
  for (int sweep = 0; sweep < kMostSweeps && beside() > 0x1p-60; ++sweep) {
    for (const auto& [p, q] : kPlanes) {
      rotate(left, found.axes, p, q);
    }
  }
  found.moments = size * left.diagonal();
  // Products of rotations leave the rotations by rounding.
  Vec3 x = found.axes.col(0);
  x /= std::sqrt(dot(x, x));
  Vec3 y = found.axes.col(1) - dot(found.axes.col(1), x) * x;
  y /= std::sqrt(dot(y, y));
  found.axes.col(0) = x;
  found.axes.col(1) = y;
  found.axes.col(2) = x.cross(y);
  return found;
}

}  // namespace careen
