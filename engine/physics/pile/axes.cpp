#include "physics/pile/axes.h"

#include <cmath>
#include <limits>

namespace careen {
namespace {

constexpr double kParallelSquared = 0x1p-14;

}  // namespace

bool PileAxes::find(const PileBox& a, const PileBox& b, double reach, int last, double tie) {
  const Vec3 apart = a.middle() - b.middle();
  cosines.noalias() = a.axes.transpose() * b.axes;
  apartA.noalias() = a.axes.transpose() * apart;
  apartB.noalias() = b.axes.transpose() * apart;
  const Vec3& halfA = a.halfExtents;
  const Vec3& halfB = b.halfExtents;
  const Mat3 sizes = cosines.cwiseAbs();
  double best = std::numeric_limits<double>::lowest();
  faceSeparation = best;
  const auto offerFace = [&](int axis, double separation) {
    const double weight = separation + (axis == last ? tie : 0);
    if (weight > best) {
      best = weight;
      face = axis;
      faceSeparation = separation;
    }
    return separation <= reach;
  };
  for (int i = 0; i < 3; ++i) {
    const double reachOfB = halfB.x() * sizes(i, 0) + halfB.y() * sizes(i, 1) + halfB.z() * sizes(i, 2);
    if (!offerFace(i, std::fabs(apartA[i]) - (halfA[i] + reachOfB))) {
      return false;
    }
  }
  for (int j = 0; j < 3; ++j) {
    const double reachOfA = halfA.x() * sizes(0, j) + halfA.y() * sizes(1, j) + halfA.z() * sizes(2, j);
    if (!offerFace(3 + j, std::fabs(apartB[j]) - (halfB[j] + reachOfA))) {
      return false;
    }
  }
  best = std::numeric_limits<double>::lowest();
  edgeSeparation = best;
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3;
    const int i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3;
      const int j2 = (j + 2) % 3;
      const double squared = cosines(i1, j) * cosines(i1, j) + cosines(i2, j) * cosines(i2, j);
      if (squared < kParallelSquared) {
        continue;
      }
      // aᵢ × bⱼ in a's frame is (0, −c(i2,j), c(i1,j)) from i on.
      const double along = std::fabs(apartA[i2] * cosines(i1, j) - apartA[i1] * cosines(i2, j));
      const double reaches = halfA[i1] * sizes(i2, j) + halfA[i2] * sizes(i1, j) + halfB[j1] * sizes(i, j2) +
                             halfB[j2] * sizes(i, j1);
      const double separation = (along - reaches) / std::sqrt(squared);
      const double weight = separation + (6 + 3 * i + j == last ? tie : 0);
      if (weight > best) {
        best = weight;
        edges = 6 + 3 * i + j;
        edgeSeparation = separation;
      }
      if (separation > reach) {
        faceSeparation = separation;
        return false;
      }
    }
  }
  return true;
}

double separationAlong(int axis, const PileBox& a, const PileBox& b, const Vec3& apart) {
  const Vec3 along = axis < 3   ? Vec3(a.axes.col(axis))
                     : axis < 6 ? Vec3(b.axes.col(axis - 3))
                                : Vec3(a.axes.col((axis - 6) / 3).cross(b.axes.col((axis - 6) % 3)));
  const auto reachOf = [&](const Vec3& half, const Mat3& axes) {
    return half.x() * std::fabs(dot(along, axes.col(0))) + half.y() * std::fabs(dot(along, axes.col(1))) +
           half.z() * std::fabs(dot(along, axes.col(2)));
  };
  const double separation =
      std::fabs(dot(along, apart)) - (reachOf(a.halfExtents, a.axes) + reachOf(b.halfExtents, b.axes));
  if (axis < 6) {
    return separation;
  }
  const double squared = along.squaredNorm();
  return squared < kParallelSquared ? std::numeric_limits<double>::lowest() : separation / std::sqrt(squared);
}

double gapAboveOfBoxes(double least, int first, const PileBox& a, const PileBox& b) {
  if (first >= 0) {
    const double separation = separationAlong(first, a, b, a.middle() - b.middle());
    if (separation > least) {
      return separation;
    }
  }
  PileAxes axes;
  axes.find(a, b, least, -1, 0);
  return axes.separation();
}

}  // namespace careen
