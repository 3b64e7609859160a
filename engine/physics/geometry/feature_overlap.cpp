#include "physics/geometry/feature_overlap.h"

#include <algorithm>
#include <cmath>

namespace careen {
namespace {

// The part of a polygon (or of a segment, a polygon of two) where low ≤ axis·x ≤ high (Sutherland and Hodgman
// 1974). Both lines at once, and each intersection from the inner end of its edge, whichever way that runs:
// the lines are alike.
SharedPolygon cut(const SharedPolygon& polygon, const Vec3& axis, double low, double high, double within) {
  SharedPolygon left;
  const std::size_t edges = polygon.count == 2 ? 1 : polygon.count;
  for (std::size_t k = 0; k < polygon.count; ++k) {
    const Vec3& from = polygon.corner[k];
    const Vec3& to = polygon.corner[(k + 1) % polygon.count];
    const double atFrom = dot(axis, from);
    const double atTo = dot(axis, to);
    if (std::max(atFrom - high, low - atFrom) <= within) {
      left.add(from);
    }
    const auto cross = [&](double outsideFrom, double outsideTo) {
      const bool fromIn = outsideFrom <= within;
      if (k >= edges || fromIn == (outsideTo <= within)) {
        return;
      }
      const Vec3& inner = fromIn ? from : to;
      const Vec3& outer = fromIn ? to : from;
      const double in = fromIn ? outsideFrom : outsideTo;
      const double out = fromIn ? outsideTo : outsideFrom;
      // An inner end on the line is itself the intersection.
      if (in < 0) {
        left.add(inner + (in / (in - out)) * (outer - inner));
      }
    };
    const bool rises = atFrom < atTo;
    cross(rises ? low - atFrom : atFrom - high, rises ? low - atTo : atTo - high);
    cross(rises ? atFrom - high : low - atFrom, rises ? atTo - high : low - atTo);
  }
  return left;
}

// The part of a face or an edge over a face, both relative to the same centre.
SharedPolygon common(const SupportFeature& incident, const SupportFeature& face, double within) {
  SharedPolygon polygon;
  polygon.add(incident.corner(1, 1));
  polygon.add(incident.corner(-1, 1));
  if (incident.freedom == 2) {
    polygon.add(incident.corner(-1, -1));
    polygon.add(incident.corner(1, -1));
  }
  for (std::size_t k = 0; k < 2 && polygon.count > 0; ++k) {
    const double middle = dot(face.axis[k], face.centre);
    polygon = cut(polygon, face.axis[k], middle - face.half[k], middle + face.half[k], within);
  }
  return polygon;
}

}  // namespace

SharedPolygon clip(const SupportFeature& incident, const SupportFeature& face, double within) {
  SharedPolygon polygon = common(incident, face, within);
  if (polygon.count == 0) {
    // Disjoint by rounding: the midpoint of the incident feature, clamped to the face.
    Vec3 point = incident.centre;
    for (std::size_t k = 0; k < 2; ++k) {
      const double along = dot(face.axis[k], point - face.centre);
      point += (std::clamp(along, -face.half[k], face.half[k]) - along) * face.axis[k];
    }
    polygon.add(point);
  }
  return polygon;
}

bool isOver(const SupportFeature& feature, const SupportFeature& face, double within) {
  if (feature.freedom > 0) {
    return common(feature, face, within).count > 0;
  }
  const Vec3 from = feature.centre - face.centre;
  return std::fabs(dot(face.axis[0], from)) <= face.half[0] + within &&
         std::fabs(dot(face.axis[1], from)) <= face.half[1] + within;
}

}  // namespace careen
