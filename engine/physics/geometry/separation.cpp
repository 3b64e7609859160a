#include "physics/geometry/separation.h"

#include <cmath>
#include <limits>
#include <utility>

#include "core/math/double_double.h"
#include "physics/world/body.h"

namespace careen {
namespace {

// Below this squared sine the plain cross product has lost three bits: compute it error-free.
constexpr double kNearlyParallelSquared = 0x1p-6;
constexpr double kParallelSquared = 0x1p-96;

// ab − cd, accurate to rounding of the result despite cancellation.
double differenceOfProducts(double a, double b, double c, double d) {
  const DoubleDouble x = twoProduct(a, b);
  const DoubleDouble y = twoProduct(c, d);
  return (x.hi - y.hi) + (x.lo - y.lo);
}

Vec3 accurateCross(const Vec3& a, const Vec3& b) {
  return {differenceOfProducts(a.y(), b.z(), a.z(), b.y()), differenceOfProducts(a.z(), b.x(), a.x(), b.z()),
          differenceOfProducts(a.x(), b.y(), a.y(), b.x())};
}

double reach(const Vec3& direction, const Mat3& worldFromBox, const Vec3& halfExtents) {
  return halfExtents.x() * std::fabs(dot(direction, worldFromBox.col(0))) +
         halfExtents.y() * std::fabs(dot(direction, worldFromBox.col(1))) +
         halfExtents.z() * std::fabs(dot(direction, worldFromBox.col(2)));
}

}  // namespace

double touchingWithin(const BoxAt& box) {
  const double radius = box.radius();
  return touchingWithin(radius, box.pose.position.cwiseAbs().sum() + radius);
}

double touchingWithin(const BoxAt& a, const BoxAt& b) {
  const double radiusA = a.radius();
  const double radiusB = b.radius();
  return touchingWithin(
      std::min(radiusA, radiusB),
      (a.pose.position.cwiseAbs().sum() + b.pose.position.cwiseAbs().sum()) + (radiusA + radiusB));
}

double cornerGap(const Pose& box, const Vec3& corner, const Vec3& normal, double offset) {
  return dot(normal, box.position) + dot(normal, box.worldFromBody * corner) - offset;
}

double gapToPlane(const BoxAt& box, const Vec3& normal, double offset) {
  return dot(normal, box.middle()) - offset - reach(normal, box.pose.worldFromBody, box.halfExtents);
}

double gapAlong(const BoxAt& a, const BoxAt& b, const Vec3& direction) {
  return dot(direction, a.middle() - b.middle()) -
         dot((a.pose.worldFromBody.transpose() * direction).cwiseAbs(), a.halfExtents) -
         dot((b.pose.worldFromBody.transpose() * direction).cwiseAbs(), b.halfExtents);
}

WallGap wallGap(const BoxAt& box, const Vec3& normal, double offset, double within) {
  const double height = dot(normal, box.middle()) - offset;
  WallGap result{.gap = gapToPlane(box, normal, offset)};
  const Vec3 upInBody = box.pose.worldFromBody.transpose() * normal;
  for (int i = 0; i < kCorners; ++i) {
    if (height + dot(upInBody, corner(box.halfExtents, i)) <= result.gap + within) {
      result.corners |= 1U << static_cast<unsigned>(i);
    }
  }
  return result;
}

BoxAxes::BoxAxes(Mat3 worldFromA, Vec3 halfExtentsA, Mat3 worldFromB, Vec3 halfExtentsB, Vec3 bToA)
    : a_(std::move(worldFromA)),
      b_(std::move(worldFromB)),
      halfA_(std::move(halfExtentsA)),
      halfB_(std::move(halfExtentsB)),
      bToA_(std::move(bToA)) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      cosines_(i, j) = dot(a_.col(i), b_.col(j));
    }
  }
  for (int i = 0; i < 3; ++i) {
    const double reachOfB = halfB_.x() * std::fabs(cosines_(i, 0)) + halfB_.y() * std::fabs(cosines_(i, 1)) +
                            halfB_.z() * std::fabs(cosines_(i, 2));
    separation_[index(i)] = std::fabs(dot(a_.col(i), bToA_)) - (halfA_(i) + reachOfB);
    const double reachOfA = halfA_.x() * std::fabs(cosines_(0, i)) + halfA_.y() * std::fabs(cosines_(1, i)) +
                            halfA_.z() * std::fabs(cosines_(2, i));
    separation_[index(3 + i)] = std::fabs(dot(b_.col(i), bToA_)) - (halfB_(i) + reachOfA);
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      addEdges(i, j);
    }
  }
  for (int k = 1; k < BoxAxis::kCount; ++k) {
    if (separation_[index(k)] > separation_[index(best_)]) {
      best_ = k;
    }
  }
}

void BoxAxes::addEdges(int i, int j) {
  const std::size_t pair = index(3 * i + j);
  Vec3& n = cross_[pair];
  double& separation = separation_[6 + pair];
  n = a_.col(i).cross(b_.col(j));
  double squared = n.squaredNorm();
  if (squared >= kNearlyParallelSquared) {
    const int i1 = (i + 1) % 3;
    const int i2 = (i + 2) % 3;
    const int j1 = (j + 1) % 3;
    const int j2 = (j + 2) % 3;
    // N·a of one edge is, up to sign, the cosine of the other: no further dot products.
    const double reachOfA = halfA_(i1) * std::fabs(cosines_(i2, j)) + halfA_(i2) * std::fabs(cosines_(i1, j));
    const double reachOfB = halfB_(j1) * std::fabs(cosines_(i, j2)) + halfB_(j2) * std::fabs(cosines_(i, j1));
    sine_[pair] = std::sqrt(squared);
    separation = (std::fabs(dot(n, bToA_)) - (reachOfA + reachOfB)) / sine_[pair];
    return;
  }
  n = accurateCross(a_.col(i), b_.col(j));
  squared = n.squaredNorm();
  sine_[pair] = std::sqrt(squared);
  if (squared < kParallelSquared) {
    separation = std::numeric_limits<double>::lowest();
    return;
  }
  const Vec3 u = n / sine_[pair];
  separation = std::fabs(dot(u, bToA_)) - (reach(u, a_, halfA_) + reach(u, b_, halfB_));
}

Vec3 BoxAxes::normal(BoxAxis axis) const {
  Vec3 n = Vec3::Zero();
  switch (axis.kind()) {
    case BoxAxis::Kind::kFaceOfA:
      n = a_.col(axis.index);
      break;
    case BoxAxis::Kind::kFaceOfB:
      n = b_.col(axis.index - 3);
      break;
    case BoxAxis::Kind::kEdges:
      n = cross(axis.edgeOfA(), axis.edgeOfB()) / sine(axis.edgeOfA(), axis.edgeOfB());
      break;
  }
  if (dot(n, bToA_) < 0) {
    n = -n;
  }
  return n;
}

}  // namespace careen
