#include "scene/union_moments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace careen {
namespace {

/// [1] Of the size of all: points this near to a plane are on it.
constexpr double kOnPlane = 0x1p-44;
/// [1] Of the size of all, or of the trace: a centre this near to the origin, or a product of inertia as
/// small, is rounding.
constexpr double kRounding = 0x1p-49;
/// [1] Of its volume: by how much a union falls short of the box around it that is one.
constexpr double kIsBox = 0x1p-44;

struct Plane {
  Vec3 normal = Vec3::Zero();  // outward
  double offset = 0;
  double above(const Vec3& point) const { return dot(normal, point) - offset; }
};

// A convex solid: its faces' corners run anticlockwise seen from outside.
using Face = std::vector<Vec3>;
using Convex = std::vector<Face>;

std::array<Plane, 6> planesOf(const BodyPart& box) {
  std::array<Plane, 6> planes;
  for (int k = 0; k < 6; ++k) {
    const int axis = k / 2;
    const Vec3 normal = (k % 2 == 0 ? 1 : -1) * Vec3(box.bodyFromPart.col(axis));
    planes.at(static_cast<std::size_t>(k)) = {normal, dot(normal, box.middle()) + box.halfExtents[axis]};
  }
  return planes;
}

Convex solidOf(const BodyPart& box) {
  // Corners of each face, as in corner(): the sign of its axis, then around it.
  Convex solid;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int minus : {0, 1}) {
      Face face;
      const int first = 4 >> ((axis + 1) % 3);
      const int second = 4 >> ((axis + 2) % 3);
      for (const int around : {0, first, first | second, second}) {
        face.push_back(box.corner((minus != 0 ? 4 >> axis : 0) | around));
      }
      if (minus != 0) {
        std::reverse(face.begin(), face.end());
      }
      solid.push_back(std::move(face));
    }
  }
  return solid;
}

// The part of a face below a plane.
Face below(const Face& face, const Plane& plane, double within) {
  Face kept;
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Vec3& from = face[k];
    const Vec3& to = face[(k + 1) % face.size()];
    const double a = plane.above(from);
    const double b = plane.above(to);
    if (a <= within) {
      kept.push_back(from);
    }
    if ((a > within && b < -within) || (a < -within && b > within)) {
      kept.emplace_back(from + a / (a - b) * (to - from));
    }
  }
  return kept;
}

// Of the points of a convex polygon in that plane, in any order, repeated or not.
Face around(std::vector<Vec3> points, const Plane& plane) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& point : points) {
    middle += point / static_cast<double>(points.size());
  }
  const Vec3 u = plane.normal.unitOrthogonal();
  const Vec3 v = plane.normal.cross(u);
  struct Around {
    double along = 0;
    double across = 0;
    bool isSecondHalf() const { return across > 0 || (across == 0 && along > 0); }
  };
  const auto from = [&](const Vec3& point) {
    return Around{.along = dot(u, Vec3(point - middle)), .across = dot(v, Vec3(point - middle))};
  };
  std::stable_sort(points.begin(), points.end(), [&](const Vec3& x, const Vec3& y) {
    const Around a = from(x);
    const Around b = from(y);
    return a.isSecondHalf() != b.isSecondHalf() ? b.isSecondHalf()
                                                : a.along * b.across - a.across * b.along > 0;
  });
  return points;
}

// The part of a solid below a plane; empty if it has no volume.
Convex below(const Convex& solid, const Plane& plane, double within) {
  Convex kept;
  std::vector<Vec3> onPlane;
  bool isAnyBelow = false;
  bool isAnyAbove = false;
  for (const Face& face : solid) {
    for (const Vec3& point : face) {
      isAnyBelow = isAnyBelow || plane.above(point) < -within;
      isAnyAbove = isAnyAbove || plane.above(point) > within;
    }
  }
  if (!isAnyAbove || !isAnyBelow) {
    return isAnyBelow ? solid : Convex();
  }
  for (const Face& face : solid) {
    Face part = below(face, plane, within);
    for (const Vec3& point : part) {
      if (std::fabs(plane.above(point)) <= within) {
        onPlane.push_back(point);
      }
    }
    const bool isFlat = std::all_of(
        part.begin(), part.end(), [&](const Vec3& point) { return std::fabs(plane.above(point)) <= within; });
    if (part.size() > 2 && !isFlat) {
      kept.push_back(std::move(part));
    }
  }
  kept.push_back(around(std::move(onPlane), plane));
  return kept;
}

// What of a solid lies outside a box.
void subtract(const Convex& solid, const BodyPart& box, double within, std::vector<Convex>& pieces) {
  const std::array<Plane, 6> planes = planesOf(box);
  Convex shared = solid;
  for (const Plane& plane : planes) {
    shared = below(shared, plane, within);
  }
  if (shared.empty()) {
    pieces.push_back(solid);
    return;
  }
  Convex rest = solid;
  for (const Plane& plane : planes) {
    Convex outside = below(rest, {-plane.normal, -plane.offset}, within);
    if (!outside.empty()) {
      pieces.push_back(std::move(outside));
    }
    rest = below(rest, plane, within);
  }
}

void dropRounding(SolidMoments& moments, double size) {
  for (int i = 0; i < 3; ++i) {
    if (std::fabs(moments.center[i]) <= kRounding * size) {
      moments.center[i] = 0;
    }
    for (int j = 0; j < 3; ++j) {
      if (i != j && std::fabs(moments.inertia(i, j)) <= kRounding * moments.inertia.trace()) {
        moments.inertia(i, j) = 0;
      }
    }
  }
}

}  // namespace

Vec3 reachOf(std::span<const BodyPart> parts) {
  Vec3 reach = Vec3::Zero();
  for (const BodyPart& part : parts) {
    for (int k = 0; k < kCorners; ++k) {
      reach = reach.cwiseMax(part.corner(k).cwiseAbs());
    }
  }
  return reach;
}

SolidMoments momentsOfUnion(std::span<const BodyPart> parts) {
  const double size = reachOf(parts).norm();
  SolidSums sums(Vec3::Zero());
  Vec3 low = parts.front().corner(0);
  Vec3 high = low;
  bool areAligned = true;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    std::vector<Convex> pieces{solidOf(parts[k])};
    for (std::size_t j = 0; j < k; ++j) {
      std::vector<Convex> left;
      for (const Convex& piece : pieces) {
        subtract(piece, parts[j], kOnPlane * size, left);
      }
      pieces = std::move(left);
    }
    for (const Convex& piece : pieces) {
      for (const Face& face : piece) {
        for (std::size_t i = 2; i < face.size(); ++i) {
          sums.add(face[0], face[i - 1], face[i]);
        }
      }
    }
    for (int c = 0; c < kCorners; ++c) {
      low = low.cwiseMin(parts[k].corner(c));
      high = high.cwiseMax(parts[k].corner(c));
    }
    areAligned = areAligned && !parts[k].turned;
  }
  SolidMoments moments = sums.moments();
  const Vec3 half = 0.5 * (high - low);
  if (areAligned && moments.volume >= (1 - kIsBox) * 8 * half.prod()) {
    moments.volume = 8 * half.prod();
    moments.center = 0.5 * (low + high);
    moments.inertia = solidBox(half, moments.volume).inertiaTensor();
  }
  dropRounding(moments, size);
  return moments;
}

}  // namespace careen
