#include "physics/pile/manifold.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/geometry/contact_frame.h"
#include "physics/geometry/separation.h"
#include "physics/pile/axes.h"
#include "physics/pile/clip.h"
#include "physics/pile/index.h"
#include "physics/world/gap.h"

namespace careen {
namespace {

constexpr double kSlack = 0x1p-10;      // [1] tolerance past the ends of an edge
constexpr double kClipSlack = 0x1p-30;  // [1] face sides moved outward, so that rounding never empties a clip
constexpr double kTie = 0x1p-12;        // [1] margin by which a new axis must beat the last one
constexpr double kSamePlace =
    0x1p-6;  // [1] within this distance a point inherits impulses from another feature
constexpr int kMostProjections = 40;
constexpr std::uint32_t kEdgeFeature = 0x100;
constexpr std::uint32_t kClosestFeature = 0x200;

// What a rebuilt manifold may inherit; not cleared first, as this is done for most manifolds in every step.
struct FormerPoint {
  Vec3 world;
  std::uint32_t feature;
  double normalImpulse;
  double normalImpulseBefore;
  double tangential1;
  double tangential2;
};

// The manifold before rebuilding.
struct Former {
  std::array<FormerPoint, PileManifold::kMost> points;  // of these, `count`
  int count;
  std::uint32_t faces;
  Vec3 tangent1;  // of the plane
};

void inherit(const Former& former, PileManifold& manifold) {
  const double near = kSamePlace * manifold.length;
  const bool sameFaces = former.faces == manifold.faces;
  // Rotated tangents lose their friction impulses: they would have another direction.
  const bool sameTangents = sameFaces || dot(former.tangent1, manifold.plane.tangent1) > 0.99;
  std::array<bool, PileManifold::kMost> taken{};
  for (int k = 0; k < manifold.count; ++k) {
    PilePoint& point = manifold.points[at(k)];
    int best = -1;
    double nearest = near * near;
    for (int i = 0; i < former.count; ++i) {
      if (taken[at(i)]) {
        continue;
      }
      const FormerPoint& old = former.points[at(i)];
      const bool comparable = sameFaces || point.feature == kEdgeFeature;
      if (comparable && old.feature == point.feature) {
        best = i;
        break;
      }
      const double distance = (old.world - point.world).squaredNorm();
      if (distance < nearest) {
        nearest = distance;
        best = i;
      }
    }
    if (best < 0) {
      continue;
    }
    const FormerPoint& old = former.points[at(best)];
    taken[at(best)] = true;
    point.normalImpulse = old.normalImpulse;
    point.normalImpulseBefore = old.normalImpulseBefore;
    if (sameTangents && (old.feature == kEdgeFeature) == (point.feature == kEdgeFeature)) {
      point.tangential1 = old.tangential1;
      point.tangential2 = old.tangential2;
    }
  }
}

Former formerOf(const PileManifold& manifold) {
  Former former;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  former.count = manifold.count;
  for (int k = 0; k < manifold.count; ++k) {
    const PilePoint& point = manifold.points[at(k)];
    former.points[at(k)] = {.world = point.world,
                            .feature = point.feature,
                            .normalImpulse = point.normalImpulse,
                            .normalImpulseBefore = point.normalImpulseBefore,
                            .tangential1 = point.tangential1,
                            .tangential2 = point.tangential2};
  }
  former.faces = manifold.faces;
  former.tangent1 = manifold.plane.tangent1;
  return former;
}

void addPoint(PileManifold& manifold, const Vec3& local, std::uint32_t feature) {
  PilePoint& point = manifold.points[at(manifold.count++)];
  point = {};
  point.local = local;
  point.feature = feature;
}

// Clips the incident face to the reference face, whose outward normal points to the incident box.
void addFace(const PileBox& a, const PileBox& b, const PileAxes& axes, double reach, double least,
             PileManifold& manifold) {
  const bool ofB = axes.face >= 3;
  const int axis = axes.face % 3;
  const PileBox& owner = ofB ? b : a;
  const PileBox& incident = ofB ? a : b;
  const Mat3 ownerFromIncident = ofB ? Mat3(axes.cosines.transpose()) : axes.cosines;
  const Vec3 center = ofB ? axes.apartB : Vec3(-axes.apartA);
  const double sign = center[axis] < 0 ? -1 : 1;
  const ClippedFace face =
      clipFace(owner, incident, ownerFromIncident, center, axis, sign, kClipSlack * manifold.length);
  manifold.planeOfB = ofB;
  manifold.planeInOwner = {.normal = sign * Vec3::Unit(axis),
                           .tangent = Vec3::Unit((axis + 1) % 3),
                           .offset = owner.halfExtents[axis]};
  manifold.faces = face.faces * 2 + (ofB ? 1 : 0);
  for (int k = 0; k < face.count; ++k) {
    const ClippedPoint& point = face.points[at(k)];
    if (point.gap <= reach && point.gap >= least) {
      addPoint(manifold, ownerFromIncident.transpose() * (point.point - center), point.feature);
    }
  }
}

// The edge pair of the best edge axis, if its closest points lie on both edges.
void addEdges(const PileBox& a, const PileBox& b, const PileAxes& axes, PileManifold& manifold) {
  const int i = (axes.edges - 6) / 3;
  const int j = (axes.edges - 6) % 3;
  Vec3 normal = a.axes.col(i).cross(b.axes.col(j));
  const Vec3 apart = a.middle() - b.middle();
  EdgeMiddles& middles = manifold.edgeMiddles;
  middles.sign = dot(normal, apart) < 0 ? -1 : 1;
  normal *= middles.sign;
  const Vec3 normalA = a.axes.transpose() * normal;
  const Vec3 normalB = b.axes.transpose() * normal;
  for (int k = 0; k < 3; ++k) {
    middles.a[k] = k == i ? 0 : normalA[k] > 0 ? -a.halfExtents[k] : a.halfExtents[k];
    middles.b[k] = k == j ? 0 : normalB[k] > 0 ? b.halfExtents[k] : -b.halfExtents[k];
  }
  const Vec3 between = apart + a.axes * middles.a - b.axes * middles.b;
  const double cosine = axes.cosines(i, j);
  const double alongA = dot(a.axes.col(i), between);
  const double alongB = dot(b.axes.col(j), between);
  const double perSquare = 1 / (1 - cosine * cosine);
  const double s = (cosine * alongB - alongA) * perSquare;
  const double t = (alongB - cosine * alongA) * perSquare;
  const double slack = kSlack * manifold.length;
  if (std::fabs(s) > a.halfExtents[i] + slack || std::fabs(t) > b.halfExtents[j] + slack) {
    return;
  }
  manifold.edgeMiddles.axisA = i;
  manifold.edgeMiddles.axisB = j;
  manifold.hasEdges = true;
  addPoint(manifold, Vec3::Zero(), kEdgeFeature);
}

Vec3 nearestIn(const PileBox& box, const Vec3& point) {
  const Vec3 middle = box.middle();
  const Vec3 local = box.axes.transpose() * (point - middle);
  return middle + box.axes * local.cwiseMax(-box.halfExtents).cwiseMin(box.halfExtents);
}

// Corner against corner or edge, outside every face: closest points by alternating projections (von Neumann)
// onto the two boxes. The plane belongs to a, the point to b.
void addClosest(const PileBox& a, const PileBox& b, double reach, PileManifold& manifold) {
  Vec3 onB = nearestIn(b, a.middle());
  Vec3 onA = nearestIn(a, onB);
  const double still = kSlack * kSlack * manifold.length;
  for (int k = 0; k < kMostProjections; ++k) {
    const Vec3 before = onB;
    onB = nearestIn(b, onA);
    onA = nearestIn(a, onB);
    if ((onB - before).squaredNorm() < still * still) {
      break;
    }
  }
  const Vec3 apart = onB - onA;
  const double distance = apart.norm();
  manifold.separation = distance;
  if (distance > reach || distance < still) {
    return;
  }
  manifold.planeOfB = false;
  manifold.faces = kClosestFeature;
  PlaneInOwner& plane = manifold.planeInOwner;
  plane.normal = a.axes.transpose() * (apart / distance);
  plane.tangent = frameOf(plane.normal).tangent1;
  plane.offset = dot(plane.normal, a.axes.transpose() * (onA - a.middle()));
  addPoint(manifold, b.axes.transpose() * (onB - b.middle()), kClosestFeature);
}

void refreshOfBoxes(const PileBox& a, const PileBox& b, PileManifold& manifold) {
  const Vec3 apart = a.middle() - b.middle();
  const Vec3 toMiddle = a.boxArm();
  const PileBox& owner = manifold.planeOfB ? b : a;
  const PileBox& other = manifold.planeOfB ? a : b;
  const double sign = manifold.planeOfB ? 1 : -1;
  const int planePoints = manifold.count - (manifold.hasEdges ? 1 : 0);
  if (planePoints > 0) {
    const Vec3 outward = owner.axes * manifold.planeInOwner.normal;
    manifold.plane.normal = sign * outward;
    manifold.plane.tangent1 = owner.axes * manifold.planeInOwner.tangent;
    manifold.plane.tangent2 = manifold.plane.normal.cross(manifold.plane.tangent1);
    const double center = sign * dot(outward, apart) - manifold.planeInOwner.offset;
    const Vec3 toOther = manifold.planeOfB ? toMiddle : Vec3(toMiddle - apart);
    for (int k = 0; k < planePoints; ++k) {
      PilePoint& point = manifold.points[at(k)];
      const Vec3 arm = other.axes * point.local;
      point.world = toOther + arm;
      point.gap = center + dot(outward, arm);
    }
  }
  if (manifold.hasEdges) {
    PilePoint& point = manifold.points[at(manifold.count - 1)];
    const Vec3 alongA = a.axes.col(manifold.edgeMiddles.axisA);
    const Vec3 alongB = b.axes.col(manifold.edgeMiddles.axisB);
    const double cosine = dot(alongA, alongB);
    const Vec3 cross = manifold.edgeMiddles.sign * alongA.cross(alongB);
    const double sine = cross.norm();
    if (sine > kSlack) {
      manifold.edges.normal = cross / sine;
      manifold.edges.tangent1 = alongA;
      manifold.edges.tangent2 = manifold.edges.normal.cross(alongA);
    }
    const Vec3 armA = a.axes * manifold.edgeMiddles.a;
    const Vec3 between = apart + armA - b.axes * manifold.edgeMiddles.b;
    point.gap = dot(manifold.edges.normal, between);
    const double square = std::max(1 - cosine * cosine, kSlack * kSlack);
    const double along = (cosine * dot(alongB, between) - dot(alongA, between)) / square;
    const double half = a.halfExtents[manifold.edgeMiddles.axisA];
    point.world = (toMiddle + armA) + std::clamp(along, -half, half) * alongA;
    // The boxes are no deeper in each other than along any axis.
    for (int k = 0; k < planePoints; ++k) {
      manifold.points[at(k)].gap = std::max(manifold.points[at(k)].gap, point.gap);
    }
  }
}

// The plane's tangents turn with it.
ContactFrame frameAt(const PileBox& wall, const WallPlane& plane) {
  ContactFrame frame = frameOf(wall.halfSpace->normal);
  if (!wall.halfSpace->course.empty()) {
    frame.normal = plane.normal;
    frame.tangent1 = wall.axes * frame.tangent1;
    frame.tangent2 = wall.axes * frame.tangent2;
  }
  return frame;
}

void refreshAtWall(const PileBox& a, const PileBox& b, PileManifold& manifold) {
  const WallPlane wall = b.plane();
  if (!b.halfSpace->course.empty()) {
    manifold.plane = frameAt(b, wall);
  }
  const double height = gap(wall, a.position);
  const Vec3 toMiddle = a.boxArm();
  for (int k = 0; k < manifold.count; ++k) {
    PilePoint& point = manifold.points[at(k)];
    point.world = toMiddle + a.axes * point.local;
    point.gap = height + dot(wall.normal, point.world);
  }
}

bool findPointsOfBoxes(const PileBox& a, const PileBox& b, double reach, PileManifold& manifold) {
  PileAxes axes;
  const double tie = kTie * manifold.length;
  if (!axes.find(a, b, reach, manifold.axis, tie)) {
    manifold.separation = axes.faceSeparation;
    return false;
  }
  const bool edgesBest = axes.edgeSeparation > axes.faceSeparation + (manifold.axis >= 6 ? 0 : tie);
  manifold.axis = edgesBest ? axes.edges : axes.face;
  manifold.separation = std::max(axes.edgeSeparation, axes.faceSeparation);
  const double least = edgesBest ? axes.edgeSeparation - PileLengths::kOverlapped * manifold.length
                                 : std::numeric_limits<double>::lowest();
  addFace(a, b, axes, reach, least, manifold);
  if (edgesBest) {
    addEdges(a, b, axes, manifold);
  }
  if (manifold.count == 0 && manifold.separation > 0) {
    addClosest(a, b, reach, manifold);
  }
  return true;
}

bool findPointsAtWall(const PileBox& a, const PileBox& b, double reach, PileManifold& manifold) {
  const WallPlane wall = b.plane();
  manifold.planeOfB = true;
  manifold.plane = frameAt(b, wall);
  const Vec3 up = a.axes.transpose() * wall.normal;
  const double height = gap(wall, a.middle());
  manifold.separation = height - dot(a.halfExtents, up.cwiseAbs());
  for (int k = 0; k < kCorners && manifold.separation <= reach; ++k) {
    const Vec3 local = corner(a.halfExtents, k);
    if (height + dot(up, local) <= reach) {
      addPoint(manifold, local, static_cast<std::uint32_t>(k));
    }
  }
  return manifold.separation <= reach;
}

double gapAtWall(const PileBox& a, const PileBox& b) {
  const WallPlane wall = b.plane();
  const Vec3 up = a.axes.transpose() * wall.normal;
  return gap(wall, a.middle()) - dot(a.halfExtents, up.cwiseAbs());
}

}  // namespace

bool buildManifold(const PileBox& a, const PileBox& b, double reach, PileManifold& manifold) {
  const Former former = formerOf(manifold);
  manifold.count = 0;
  manifold.hasEdges = false;
  manifold.moved = 0;
  const bool found = b.isBox() ? findPointsOfBoxes(a, b, reach, manifold)
                               : findPointsAtWall(a, b, reach, manifold);
  if (found) {
    refreshManifold(a, b, manifold);
    inherit(former, manifold);
  }
  return found;
}

void refreshManifold(const PileBox& a, const PileBox& b, PileManifold& manifold) {
  if (b.isBox()) {
    refreshOfBoxes(a, b, manifold);
  } else {
    refreshAtWall(a, b, manifold);
  }
}

double relativeMotion(const PileBody& a, const PileBody& b, double h) {
  const Vec3 apart = b.position - a.position;
  if (!b.isBox()) {
    return b.isDriven() ? a.ahead + h * ((b.velocity - b.omega.cross(apart)).norm() + a.radius * b.omega.norm())
                        : a.ahead;
  }
  const Vec3 slip = b.velocity - a.velocity - a.omega.cross(apart);
  const Vec3 spin = b.omega - a.omega;
  return h * (slip.cwiseAbs().sum() + b.radius * spin.cwiseAbs().sum());
}

double wayNearer(const PileBody& a, const PileBody& b, const Vec3& apart) {
  const Vec3 way = a.position - b.position - apart;
  return b.isBox() ? way.norm() : std::abs(dot(b.plane().normal, way));
}

double gapAbove(double least, int axis, const PileBox& a, const PileBox& b) {
  return b.isBox() ? gapAboveOfBoxes(least, axis, a, b) : gapAtWall(a, b);
}

double overlapOf(const PileBox& a, const PileBox& b) {
  return std::max(
      0.0, b.isBox() ? -BoxAxes(a.axes, a.halfExtents, b.axes, b.halfExtents, a.middle() - b.middle()).gap()
                     : -gapAtWall(a, b));
}

}  // namespace careen
