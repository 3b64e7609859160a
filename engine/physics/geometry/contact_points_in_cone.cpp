#include "physics/geometry/contact_points_in_cone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/math/double_double.h"
#include "physics/geometry/contact_manifold.h"
#include "physics/geometry/normal_cone.h"
#include "physics/geometry/separating_axes.h"
#include "physics/geometry/support_feature.h"

namespace careen {
namespace {

// a·b to rounding of the result, so that the order of the axes changes no bit.
double accurateDot(const Vec3& a, const Vec3& b) {
  return static_cast<double>(
      normalized(twoProduct(a.x(), b.x()) + twoProduct(a.y(), b.y()) + twoProduct(a.z(), b.z())));
}

// Lateral offset of parts that count as touching, in touching tolerances.
constexpr double kOffset = 8;
// Sine of half the angle of a cone below which it is one direction: rounding would decide on its middle.
constexpr double kNarrow = 0x1p-27;
// Squared sine below which a bound is parallel to an edge.
constexpr double kAlongEdgeSquared = 0x1p-80;

// A direction inside the cone of those that separate equally well, whose extreme rays are among the 15 axes.
std::optional<Vec3> insideOfCone(const BoxAxes& axes, AxisSet set) {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < BoxAxis::kCount; ++k) {
    if (contains(set, k)) {
      sum += axes.normal({k});
    }
  }
  return set != 0 ? std::optional(Vec3(sum / std::sqrt(dot(sum, sum)))) : std::nullopt;
}

// Which way a box's axis points into the cone, on whose side of the box the other lies.
Vec3 boundOf(const Vec3& axis, const Vec3& inside) { return dot(axis, inside) < 0 ? Vec3(-axis) : axis; }

// The cone of an edge or a corner of each box; `edge` is null for two corners.
NormalCone coneOf(const BoxAt& a, const SupportFeature& ofA, const BoxAt& b, const SupportFeature& ofB,
                  const Vec3* edge, const Vec3& inside) {
  NormalCone cone;
  const auto add = [&](const Mat3& axes, const SupportFeature& feature) {
    for (int i = 0; i < 3; ++i) {
      const Vec3 axis = axes.col(i);
      if (feature.freedom == 1 && feature.axis[0] == axis) {
        continue;
      }
      const Vec3 bound = boundOf(axis, inside);
      if (edge == nullptr) {
        cone.add(bound);
        continue;
      }
      const Vec3 across = bound - accurateDot(bound, *edge) * *edge;
      const double squared = accurateDot(across, across);
      if (squared > kAlongEdgeSquared) {
        cone.add(across / std::sqrt(squared));
      }
    }
  };
  add(a.pose.worldFromBody, ofA);
  add(b.pose.worldFromBody, ofB);
  return cone;
}

// Places on the edges or corners of two boxes, each relative to its own box, that touch.
struct Touch {
  Vec3 onA = Vec3::Zero();
  Vec3 onB = Vec3::Zero();
};
struct Touches {
  std::array<Touch, 2> at;
  std::size_t count = 0;
};

// Of parallel edges, the ends of their common part. `link` runs from the middle of a's edge to that of b's.
Touches alongEdges(const SupportFeature& a, const SupportFeature& b, const Vec3& link) {
  const Vec3& u = a.axis[0];
  const Vec3 v = boundOf(b.axis[0], u);
  const Vec3 both = u + v;
  const double middle = accurateDot(link, both) / std::sqrt(accurateDot(both, both));
  const auto at = [&](double alongA, double alongB) {
    return Touch{.onA = a.centre + std::clamp(alongA, -a.half[0], a.half[0]) * u,
                 .onB = b.centre + std::clamp(alongB, -b.half[0], b.half[0]) * v};
  };
  return {.at = {at(middle - b.half[0], -a.half[0] - middle), at(middle + b.half[0], a.half[0] - middle)},
          .count = 2};
}

Touches touchesOf(const SupportFeature& a, const SupportFeature& b, const Vec3& link) {
  if (a.freedom == 1 && b.freedom == 1) {
    return alongEdges(a, b, link);
  }
  Touch touch{.onA = a.centre, .onB = b.centre};
  if (a.freedom == 1) {
    touch.onA += std::clamp(accurateDot(link, a.axis[0]), -a.half[0], a.half[0]) * a.axis[0];
  } else if (b.freedom == 1) {
    touch.onB -= std::clamp(accurateDot(link, b.axis[0]), -b.half[0], b.half[0]) * b.axis[0];
  }
  return {.at = {touch}, .count = 1};
}

}  // namespace

std::optional<ContactPoints> pointsInCone(const BoxAt& a, const BoxAt& b, const BoxAxes& axes,
                                          const Vec3& bToA, double within) {
  const double touching = touchingWithin(a, b);
  const std::optional<Vec3> inside = insideOfCone(axes, separatingAxes(a, b, axes, touching));
  if (!inside) {
    return std::nullopt;
  }
  const SupportFeature ofA = furthest(a, -*inside, touching);
  const SupportFeature ofB = furthest(b, *inside, touching);
  if (ofA.freedom > 1 || ofB.freedom > 1) {
    return std::nullopt;
  }
  const Vec3* edge = ofA.freedom == 1 ? &ofA.axis[0] : ofB.freedom == 1 ? &ofB.axis[0] : nullptr;
  if (ofA.freedom == 1 && ofB.freedom == 1) {
    edge = nullptr;  // all bounds are perpendicular to both
  }
  const NormalCone::Centre centre = coneOf(a, ofA, b, ofB, edge, *inside).centre();
  if (!(centre.margin > kNarrow)) {
    return std::nullopt;
  }
  ContactManifold manifold(centre.direction, bToA, within);
  manifold.liesInCone();
  const Touches touches = touchesOf(ofA, ofB, ofB.centre - ofA.centre - bToA);
  for (std::size_t k = 0; k < touches.count; ++k) {
    const auto& [onA, onB] = touches.at[k];
    const Vec3 offset = (onA - onB) + bToA;
    const Vec3 lateral = offset - dot(offset, centre.direction) * centre.direction;
    if (lateral.squaredNorm() > kOffset * kOffset * touching * touching) {
      return std::nullopt;
    }
    manifold.add(0.5 * (onA + (onB - bToA)), 0.5 * (onB + (onA + bToA)));
  }
  return manifold.points();
}

}  // namespace careen
