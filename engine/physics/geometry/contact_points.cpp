#include "physics/geometry/contact_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "physics/geometry/contact_manifold.h"
#include "physics/geometry/contact_points_in_cone.h"
#include "physics/geometry/feature_overlap.h"
#include "physics/geometry/support_feature.h"

namespace careen {
namespace {

// Two edges, each relative to its own box: the midpoint of their closest points, or the ends of the overlap
// of parallel edges.
void cross(const SupportFeature& a, const SupportFeature& b, const Vec3& bToA, double within,
           ContactManifold& manifold) {
  const Vec3& u = a.axis[0];
  const Vec3& v = b.axis[0];
  const Vec3 link = b.centre - a.centre - bToA;
  const Vec3 n = u.cross(v);
  const double squaredSine = n.squaredNorm();
  const double shorter = std::min(a.half[0], b.half[0]);
  if (4 * shorter * shorter * squaredSine > within * within) {
    const double alongA = std::clamp(dot(link.cross(v), n) / squaredSine, -a.half[0], a.half[0]);
    const double alongB = std::clamp(dot(link.cross(u), n) / squaredSine, -b.half[0], b.half[0]);
    const Vec3 onA = a.centre + alongA * u;
    const Vec3 onB = b.centre + alongB * v;
    manifold.add(0.5 * (onA + (onB - bToA)), 0.5 * (onB + (onA + bToA)));
    return;
  }
  const double middle = dot(link, u);
  const double low = std::max(-a.half[0], middle - b.half[0]);
  const double high = std::min(a.half[0], middle + b.half[0]);
  manifold.addOnA(a.centre + (low <= high ? low : 0.5 * (low + high)) * u);
  manifold.addOnA(a.centre + (low <= high ? high : 0.5 * (low + high)) * u);
}

// The contact axis: a face axis if its separation is as good as equals the best. Where that is of two edges,
// the other box's nearest part may lie beside the face: then they do not touch there.
BoxAxis contactAxis(const BoxAt& a, const BoxAt& b, const BoxAxes& axes, const Vec3& bToA, double within) {
  if (axes.best().kind() != BoxAxis::Kind::kEdges) {
    return axes.best();
  }
  std::array<int, 6> faces{0, 1, 2, 3, 4, 5};
  std::stable_sort(faces.begin(), faces.end(),
                   [&](int x, int y) { return axes.separation({x}) > axes.separation({y}); });
  for (const int k : faces) {
    if (axes.separation({k}) < axes.gap() - within) {
      break;
    }
    const Vec3 normal = axes.normal({k});
    const SupportFeature ofA = furthest(a, -normal, within);
    const SupportFeature ofB = furthest(b, normal, within).seenFrom(bToA);
    if (k < 3 ? isOver(ofB, ofA, within) : isOver(ofA, ofB, within)) {
      return {k};
    }
  }
  return axes.best();
}

// The best of some axes, a face's if there is one.
BoxAxis bestAmong(const BoxAxes& axes, AxisSet among) {
  int best = -1;
  for (int k = 0; k < BoxAxis::kCount; ++k) {
    const bool better = best < 0 || (axes.separation({k}) > axes.separation({best}) && (best >= 6 || k < 6));
    best = contains(among, k) && better ? k : best;
  }
  return {best};
}

ContactPoints pointsInOrder(const BoxAt& a, const BoxAt& b, double apart, AxisSet among) {
  const double within = std::max(apart, touchingWithin(a, b));
  const Vec3 bToA = a.middle() - b.middle();
  const BoxAxes axes(a, b);
  const bool isAny = among == kAllAxes;
  if (const std::optional<ContactPoints> points =
          isAny ? pointsInCone(a, b, axes, bToA, within) : std::nullopt) {
    return *points;
  }
  const BoxAxis axis = isAny ? contactAxis(a, b, axes, bToA, within) : bestAmong(axes, among);
  const Vec3 normal = axes.normal(axis);

  const SupportFeature ofA = furthest(a, -normal, within);
  const SupportFeature ofB = furthest(b, normal, within);
  ContactManifold manifold(normal, bToA, within);
  if (ofA.freedom == 0 || ofB.freedom == 0) {
    // Of two corners, the contact point is the one that meets the other box's face or edge.
    const bool cornerOfA = ofA.freedom == 0 && axis.kind() != BoxAxis::Kind::kFaceOfA;
    if (cornerOfA || ofB.freedom > 0) {
      manifold.addOnA(ofA.centre);
    } else {
      manifold.addOnB(ofB.centre);
    }
  } else if (ofA.freedom == 1 && ofB.freedom == 1) {
    cross(ofA, ofB, bToA, within, manifold);
    // The smaller face is clipped to the larger, so that one that lies within keeps its corners bitwise.
  } else if (ofB.freedom == 2 && (ofA.freedom == 1 || ofA.extent() < ofB.extent())) {
    const SharedPolygon shared = clip(ofA, ofB.seenFrom(bToA), within);
    for (std::size_t k = 0; k < shared.count; ++k) {
      manifold.addOnA(shared.corner[k]);
    }
  } else {
    const SharedPolygon shared = clip(ofB, ofA.seenFrom(-bToA), within);
    for (std::size_t k = 0; k < shared.count; ++k) {
      manifold.addOnB(shared.corner[k]);
    }
  }
  return manifold.points();
}

}  // namespace

ContactPoint swapped(const ContactPoint& point) {
  return {.armA = point.armB, .armB = point.armA, .normal = -point.normal, .inCone = point.inCone};
}

ContactPoints boxContactPoints(const BoxAt& a, const BoxAt& b, double apart, AxisSet among) {
  const bool swaps = comesFirst(b, a);
  const bool centered = a.isCentered() && b.isCentered();
  const ContactPoints found =
      swaps ? pointsInOrder(b, a, apart, swapped(among)) : pointsInOrder(a, b, apart, among);
  if (!swaps && centered) {
    return found;
  }
  ContactPoints points;
  for (const ContactPoint& each : found) {
    ContactPoint point = swaps ? swapped(each) : each;
    if (!centered) {
      point.armA += a.arm();
      point.armB += b.arm();
    }
    points.add(point);
  }
  return points;
}

}  // namespace careen
