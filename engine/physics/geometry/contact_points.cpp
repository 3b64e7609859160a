#include "physics/geometry/contact_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/math/double_double.h"
#include "physics/geometry/normal_cone.h"

namespace careen {
namespace {

// Support feature: the corner, edge or face of a box that lies furthest along a direction. Positions are
// relative to a box's middle: what is symmetric about it stays so bitwise wherever the boxes are.
struct Feature {
  Vec3 centre = Vec3::Zero();
  int freedom = 0;               // 0 corner, 1 edge, 2 face
  std::array<Vec3, 2> axis;      // [1] directions along which it extends
  std::array<double, 2> half{};  // [m]

  double extent() const { return half[0] * half[1]; }
  Feature seenFrom(const Vec3& place) const {
    Feature moved = *this;
    moved.centre -= place;
    return moved;
  }
  Vec3 corner(double first, double second) const {
    Vec3 point = centre;
    if (freedom > 0) {
      point += first * half[0] * axis[0];
    }
    if (freedom > 1) {
      point += second * half[1] * axis[1];
    }
    return point;
  }
};

Feature furthest(BoxAt box, const Vec3& direction, double within) {
  const Pose& pose = box.pose;
  const Vec3& halfExtents = box.halfExtents;
  Feature feature{.axis = {Vec3::Zero(), Vec3::Zero()}};
  const Vec3 along = pose.worldFromBody.transpose() * direction;
  // A box thinner than the tolerance still has two sides: its steepest axis never counts as level.
  int steepest = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::fabs(along(i)) > std::fabs(along(steepest))) {
      steepest = i;
    }
  }
  for (int i = 0; i < 3; ++i) {
    if (i != steepest && 2 * halfExtents(i) * std::fabs(along(i)) <= within) {
      const auto k = static_cast<std::size_t>(feature.freedom);
      feature.axis[k] = pose.worldFromBody.col(i);
      feature.half[k] = halfExtents(i);
      ++feature.freedom;
    } else {
      feature.centre += (along(i) > 0 ? halfExtents(i) : -halfExtents(i)) * pose.worldFromBody.col(i);
    }
  }
  return feature;
}

class Manifold {
 public:
  Manifold(Vec3 normal, Vec3 bToA, double within, bool inCone = false)
      : normal_(std::move(normal)), bToA_(std::move(bToA)), within_(within), inCone_(inCone) {}

  void addOnA(const Vec3& armA) { add(armA, armA + bToA_); }
  void addOnB(const Vec3& armB) { add(armB - bToA_, armB); }
  void add(const Vec3& armA, const Vec3& armB) {
    add({.armA = armA, .armB = armB, .normal = normal_, .inCone = inCone_});
  }
  // Of points closer together than the tolerance, the one furthest from both centres: none for being listed
  // first, which mirrors would change.
  ContactPoints points() const {
    ContactPoints points;
    for (std::size_t k = 0; k < count_; ++k) {
      if (std::none_of(points.begin(), points.end(), [&](const ContactPoint& other) {
            return (other.armA - all_[k].armA).squaredNorm() <= within_ * within_;
          })) {
        points.add(all_[k]);
      }
    }
    return points;
  }

 private:
  static double squaredArms(const ContactPoint& point) {
    return point.armA.squaredNorm() + point.armB.squaredNorm();
  }
  void add(const ContactPoint& point) {
    std::size_t k = count_++;
    for (; k > 0 && squaredArms(all_[k - 1]) < squaredArms(point); --k) {
      all_[k] = all_[k - 1];
    }
    all_[k] = point;
  }

  Vec3 normal_;
  Vec3 bToA_;
  double within_;
  bool inCone_;
  std::array<ContactPoint, ContactPoints::kMost> all_;  // furthest first
  std::size_t count_ = 0;
};

// A convex polygon of at most four corners, clipped by at most four lines.
struct Polygon {
  std::array<Vec3, ContactPoints::kMost> corner;
  std::size_t count = 0;

  void add(const Vec3& point) {
    if (count < corner.size()) {
      corner[count++] = point;
    }
  }
};

// The part of a polygon (or of a segment, a polygon of two) where low ≤ axis·x ≤ high (Sutherland and Hodgman
// 1974). Both lines at once, and each intersection from the inner end of its edge, whichever way that runs:
// the lines are alike.
Polygon cut(const Polygon& polygon, const Vec3& axis, double low, double high, double within) {
  Polygon left;
  const std::size_t edges = polygon.count == 2 ? 1 : polygon.count;
  for (std::size_t k = 0; k < polygon.count; ++k) {
    const Vec3& from = polygon.corner[k];
    const Vec3& to = polygon.corner[(k + 1) % polygon.count];
    const double atFrom = axis.dot(from);
    const double atTo = axis.dot(to);
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
Polygon common(const Feature& incident, const Feature& face, double within) {
  Polygon polygon;
  polygon.add(incident.corner(1, 1));
  polygon.add(incident.corner(-1, 1));
  if (incident.freedom == 2) {
    polygon.add(incident.corner(-1, -1));
    polygon.add(incident.corner(1, -1));
  }
  for (std::size_t k = 0; k < 2 && polygon.count > 0; ++k) {
    const double middle = face.axis[k].dot(face.centre);
    polygon = cut(polygon, face.axis[k], middle - face.half[k], middle + face.half[k], within);
  }
  return polygon;
}

// The same, at least one point.
Polygon clip(const Feature& incident, const Feature& face, double within) {
  Polygon polygon = common(incident, face, within);
  if (polygon.count == 0) {
    // Disjoint by rounding: the midpoint of the incident feature, clamped to the face.
    Vec3 point = incident.centre;
    for (std::size_t k = 0; k < 2; ++k) {
      const double along = face.axis[k].dot(point - face.centre);
      point += (std::clamp(along, -face.half[k], face.half[k]) - along) * face.axis[k];
    }
    polygon.add(point);
  }
  return polygon;
}

// Two edges, each relative to its own box: the midpoint of their closest points, or the ends of the overlap
// of parallel edges.
void cross(const Feature& a, const Feature& b, const Vec3& bToA, double within, Manifold& manifold) {
  const Vec3& u = a.axis[0];
  const Vec3& v = b.axis[0];
  const Vec3 link = b.centre - a.centre - bToA;
  const Vec3 n = u.cross(v);
  const double squaredSine = n.squaredNorm();
  const double shorter = std::min(a.half[0], b.half[0]);
  if (4 * shorter * shorter * squaredSine > within * within) {
    const double alongA = std::clamp(link.cross(v).dot(n) / squaredSine, -a.half[0], a.half[0]);
    const double alongB = std::clamp(link.cross(u).dot(n) / squaredSine, -b.half[0], b.half[0]);
    const Vec3 onA = a.centre + alongA * u;
    const Vec3 onB = b.centre + alongB * v;
    manifold.add(0.5 * (onA + (onB - bToA)), 0.5 * (onB + (onA + bToA)));
    return;
  }
  const double middle = link.dot(u);
  const double low = std::max(-a.half[0], middle - b.half[0]);
  const double high = std::min(a.half[0], middle + b.half[0]);
  manifold.addOnA(a.centre + (low <= high ? low : 0.5 * (low + high)) * u);
  manifold.addOnA(a.centre + (low <= high ? high : 0.5 * (low + high)) * u);
}

// Whether some of a feature lies over a face, both relative to the same centre.
bool isOver(const Feature& feature, const Feature& face, double within) {
  if (feature.freedom > 0) {
    return common(feature, face, within).count > 0;
  }
  const Vec3 from = feature.centre - face.centre;
  return std::fabs(face.axis[0].dot(from)) <= face.half[0] + within &&
         std::fabs(face.axis[1].dot(from)) <= face.half[1] + within;
}

// The contact axis: a face axis if its separation is as good as equals the best. Where that is of two edges,
// the other box's nearest part may lie beside the face: then they do not touch there.
BoxAxis contactAxis(BoxAt a, BoxAt b, const BoxAxes& axes, const Vec3& bToA, double within) {
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
    const Feature ofA = furthest(a, -normal, within);
    const Feature ofB = furthest(b, normal, within).seenFrom(bToA);
    if (k < 3 ? isOver(ofB, ofA, within) : isOver(ofA, ofB, within)) {
      return {k};
    }
  }
  return axes.best();
}

// ---- Edges along edges, corners on edges, corners on corners.

// a·b to rounding of the result, so that the order of the axes changes no bit.
double accurateDot(const Vec3& a, const Vec3& b) {
  return static_cast<double>(
      normalized(twoProduct(a.x(), b.x()) + twoProduct(a.y(), b.y()) + twoProduct(a.z(), b.z())));
}

// Lateral offset of parts that count as touching, in touching tolerances.
constexpr double kOffset = 8;
// Normals count as different if their angle moves the thinnest part by this many touching tolerances.
constexpr double kDifferent = 8;
// Sine of half the angle of a cone below which it is one direction: rounding would decide on its middle.
constexpr double kNarrow = 0x1p-27;
// Squared sine below which a bound is parallel to an edge.
constexpr double kAlongEdgeSquared = 0x1p-80;

// A direction inside the cone of those that separate equally well, if they are a cone and not one direction:
// its extreme rays are among the 15 axes.
std::optional<Vec3> insideOfCone(const BoxAxes& axes, double different, double within) {
  const Vec3 best = axes.normal(axes.best());
  Vec3 sum = Vec3::Zero();
  bool differ = false;
  for (int k = 0; k < BoxAxis::kCount; ++k) {
    if (axes.separation({k}) >= axes.gap() - within) {
      const Vec3 normal = axes.normal({k});
      differ = differ || (normal - best).squaredNorm() > different * different;
      sum += normal;
    }
  }
  return differ ? std::optional(Vec3(sum / std::sqrt(sum.dot(sum)))) : std::nullopt;
}

// Which way a box's axis points into the cone, on whose side of the box the other lies.
Vec3 boundOf(const Vec3& axis, const Vec3& inside) { return axis.dot(inside) < 0 ? Vec3(-axis) : axis; }

// The cone of an edge or a corner of each box; `edge` is null for two corners.
NormalCone coneOf(BoxAt a, const Feature& ofA, BoxAt b, const Feature& ofB, const Vec3* edge,
                  const Vec3& inside) {
  NormalCone cone;
  const auto add = [&](const Mat3& axes, const Feature& feature) {
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
Touches alongEdges(const Feature& a, const Feature& b, const Vec3& link) {
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

Touches touchesOf(const Feature& a, const Feature& b, const Vec3& link) {
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

// Contact points of two boxes that touch with parts of which neither is a face, and whose edges do not cross.
std::optional<ContactPoints> pointsInCone(BoxAt a, BoxAt b, const BoxAxes& axes, const Vec3& bToA,
                                          double within) {
  const double touching = touchingWithin(a, b);
  const double thinnest = std::min(a.halfExtents.minCoeff(), b.halfExtents.minCoeff());
  const std::optional<Vec3> inside = insideOfCone(axes, kDifferent * touching / thinnest, touching);
  if (!inside) {
    return std::nullopt;
  }
  const Feature ofA = furthest(a, -*inside, touching);
  const Feature ofB = furthest(b, *inside, touching);
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
  Manifold manifold(centre.direction, bToA, within, true);
  const Touches touches = touchesOf(ofA, ofB, ofB.centre - ofA.centre - bToA);
  for (std::size_t k = 0; k < touches.count; ++k) {
    const auto& [onA, onB] = touches.at[k];
    const Vec3 offset = (onA - onB) + bToA;
    const Vec3 lateral = offset - offset.dot(centre.direction) * centre.direction;
    if (lateral.squaredNorm() > kOffset * kOffset * touching * touching) {
      return std::nullopt;
    }
    manifold.add(0.5 * (onA + (onB - bToA)), 0.5 * (onB + (onA + bToA)));
  }
  return manifold.points();
}

ContactPoints pointsInOrder(BoxAt a, BoxAt b, double apart) {
  const double within = std::max(apart, touchingWithin(a, b));
  const Vec3 bToA = a.middle() - b.middle();
  const BoxAxes axes(a, b);
  if (const std::optional<ContactPoints> points = pointsInCone(a, b, axes, bToA, within)) {
    return *points;
  }
  const BoxAxis axis = contactAxis(a, b, axes, bToA, within);
  const Vec3 normal = axes.normal(axis);

  const Feature ofA = furthest(a, -normal, within);
  const Feature ofB = furthest(b, normal, within);
  Manifold manifold(normal, bToA, within);
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
    const Polygon shared = clip(ofA, ofB.seenFrom(bToA), within);
    for (std::size_t k = 0; k < shared.count; ++k) {
      manifold.addOnA(shared.corner[k]);
    }
  } else {
    const Polygon shared = clip(ofB, ofA.seenFrom(-bToA), within);
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

ContactPoints boxContactPoints(BoxAt a, BoxAt b, double apart) {
  const bool swaps = comesFirst(b, a);
  const bool centered = a.isCentered() && b.isCentered();
  const ContactPoints found = swaps ? pointsInOrder(b, a, apart) : pointsInOrder(a, b, apart);
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

double partingSpeed(BoxAt a, BoxAt b, const Vec3& velocity) {
  const BoxAxes axes(a, b);
  const double within = touchingWithin(a, b);
  double fastest = std::numeric_limits<double>::lowest();
  for (int k = 0; k < BoxAxis::kCount; ++k) {
    if (axes.separation({k}) >= axes.gap() - within) {
      fastest = std::max(fastest, axes.normal({k}).dot(velocity));
    }
  }
  return fastest;
}

}  // namespace careen
