#pragma once

#include <array>
#include <cstdint>

#include "core/math/linear_algebra.h"
#include "physics/geometry/contact_frame.h"
#include "physics/pile/body.h"

namespace careen {

/// Lengths relative to the smallest size of the pair's smaller body: 2 mm for boxes of 0.5 m is 0.004.
struct PileLengths {
  static constexpr double kRebuild = 0x1p-8;  ///< relative motion after which a manifold is rebuilt
  static constexpr double kReach = 0x1p-5;    ///< points with a larger gap are omitted
  static constexpr double kOverlapped =
      0x1p-9;  ///< points deeper by more than the best edge axis' penetration are omitted
};

/// A contact point with its accumulated impulses, matched by feature when the manifold is rebuilt.
struct PilePoint {
  Vec3 local = Vec3::Zero();  ///< [m] from the middle of the box it belongs to, in its frame
  Vec3 world = Vec3::Zero();  ///< [m] from a's centre of mass
  double gap = 0;             ///< [m]
  std::uint32_t feature = 0;
  double normalImpulse = 0;        ///< [N s] of the last substep
  double normalImpulseBefore = 0;  ///< [N s] of the substep before
  double tangential1 = 0;          ///< [N s] along the manifold's tangents
  double tangential2 = 0;
  // Of the present step:
  double curved = 0;     ///< [m] second order of the gap at its end
  double speed = 0;      ///< [m/s] of the gap, before impulses
  bool strikes = false;  ///< faster than what forces give in a step
  int row = -1;          ///< in the solver, −1: too far to meet
};

/// The reference plane in the frame of the box that owns it.
struct PlaneInOwner {
  Vec3 normal = Vec3::UnitZ();   ///< [1] outward
  Vec3 tangent = Vec3::UnitX();  ///< [1]
  double offset = 0;             ///< [m]
};

/// The edges of a pair, and where they lie in their boxes.
struct EdgeMiddles {
  int axisA = 0;
  int axisB = 0;
  Vec3 a = Vec3::Zero();  ///< [m] from the box's middle, a's frame
  Vec3 b = Vec3::Zero();  ///< [m] b's frame
  double sign = 1;        ///< for which a's edge × b's edge points from b to a
};

/// Contact manifold of a box and another one, or a half-space. Gaps are exact functions of the two poses for
/// fixed features: points of one body against a reference plane of the other, no deeper than the one edge
/// pair.
struct PileManifold {
  static constexpr int kMost = 9;  // intersection of two quadrilaterals, and an edge pair

  int a = 0;
  int b = 0;
  int boxA = 0;       ///< which of a's boxes
  int boxB = 0;       ///< likewise of b's
  double length = 0;  ///< [m] smallest size of the smaller body
  Material material;  ///< of the pair
  double span = 0;    ///< [s] in which its impulses acted

  int axis = -1;          ///< best axis at the last rebuild, as in BoxAxis
  bool planeOfB = false;  ///< b owns the reference plane
  std::uint32_t faces = 0;
  PlaneInOwner planeInOwner;

  bool hasEdges = false;  ///< the last point is the edge pair
  EdgeMiddles edgeMiddles;

  ContactFrame plane;  ///< normal from b to a, tangents fixed in the body that owns the reference plane
  ContactFrame edges;
  int count = 0;
  std::array<PilePoint, kMost> points;

  bool strikes = false;         ///< a point of it strikes in this step
  bool meets = false;           ///< and meets
  bool carries = false;         ///< one of the two fell asleep, and nothing woke it since
  Vec3 carried = Vec3::Zero();  ///< [N] on a, when it did

  double moved = 0;       ///< [m] bound on the relative motion since the last rebuild
  double separation = 0;  ///< [m] along the best axis at the last rebuild
  double reach = 0;       ///< [m] all points with smaller gaps are included

  /// Forgets what it was of. Points are written before they are read, so they stay: that would cost more than
  /// to find that two boxes do not touch.
  void clear() {
    axis = -1;
    faces = 0;
    hasEdges = carries = false;
    count = 0;
    moved = separation = reach = 0;
  }
  const ContactFrame& frameOf(int point) const { return hasEdges && point == count - 1 ? edges : plane; }
};

/// Rebuilds the manifold with points of gap up to `reach` [m]; impulses of persisting features are kept. If
/// the bodies are farther apart, returns false and leaves no points; `separation` is then a lower bound of
/// the distance.
bool buildManifold(const PileBox& a, const PileBox& b, double reach, PileManifold& manifold);

/// Updates gaps, points and frames to the current poses.
void refreshManifold(const PileBox& a, const PileBox& b, PileManifold& manifold);

/// The same of the bodies whose boxes they are.
inline bool buildBetween(const PileBody& a, const PileBody& b, PileManifold& manifold) {
  return withBoxes(a, manifold.boxA, b, manifold.boxB, [&](const PileBox& boxA, const PileBox& boxB) {
    return buildManifold(boxA, boxB, manifold.reach, manifold);
  });
}
inline void refreshBetween(const PileBody& a, const PileBody& b, PileManifold& manifold) {
  withBoxes(a, manifold.boxA, b, manifold.boxB,
            [&](const PileBox& boxA, const PileBox& boxB) { refreshManifold(boxA, boxB, manifold); });
}

/// Bound [m] on the relative motion of the bodies in h [s], seen from a; of one whose step is as long.
double relativeMotion(const PileBody& a, const PileBody& b, double h);
/// [m] How much nearer they can have come since a's centre was `apart` from b's, if they did not turn.
double wayNearer(const PileBody& a, const PileBody& b, const Vec3& apart);

/// [m] The gap or, if it is above `least`, a lower bound of it that is, too. `axis`: of their manifold, or
/// −1.
double gapAbove(double least, int axis, const PileBox& a, const PileBox& b);
/// Penetration depth [m], of boxes by all 15 axes; 0 if they are disjoint.
double overlapOf(const PileBox& a, const PileBox& b);

}  // namespace careen
