#pragma once

#include <array>
#include <cstdint>

#include "core/math/linear_algebra.h"
#include "physics/pile/body.h"
#include "physics/world/partner.h"

namespace careen {

/// All lengths are parts of the smallest size of the pair's smaller box: 2 mm for boxes of 0.5 m are 0.004.
struct PileLengths {
  static constexpr double kRebuild = 0x1p-8;  ///< relative motion after which a manifold is built anew
  static constexpr double kReach = 0x1p-5;    ///< points with more gap than this can wait
  static constexpr double kOverlapped =
      0x1p-9;  ///< points that a better axis contradicts by more are left out
};

/// A point of a manifold and the impulses it bore, kept through rebuilding by its feature.
struct PilePoint {
  Vec3 local = Vec3::Zero();  ///< [m] in the frame of the box whose point it is
  Vec3 world = Vec3::Zero();  ///< [m] from a's centre
  double gap = 0;             ///< [m]
  std::uint32_t feature = 0;
  double normalImpulse = 0;        ///< [N s] last substep's
  double normalImpulseBefore = 0;  ///< [N s] that of the one before
  double tangential1 = 0;          ///< [N s] along the manifold's tangents
  double tangential2 = 0;
  int row = -1;  ///< of the solver, −1: too far apart to need one
};

/// Directions at a contact: normal from b to a, and a right-handed pair of tangents that keeps its place in
/// the body that owns the plane.
struct PileFrame {
  Vec3 normal = Vec3::UnitZ();
  Vec3 tangent1 = Vec3::UnitX();
  Vec3 tangent2 = Vec3::UnitY();
};

/// Where two boxes, or a box and a wall, can touch. Gaps are exact functions of the two poses, of features
/// that stay: points of one box against a plane of the other, and one edge of each.
struct PileManifold {
  static constexpr int kMost = 9;  // two quadrilaterals laid on each other, and an edge pair

  int a = 0;
  Partner b = {};
  double length = 0;  ///< [m] smallest size of the smaller box
  double friction = 0;
  double restitution = 0;

  int axis = -1;          ///< last best axis as in BoxAxis
  int planeAxis = 0;      ///< of the owner's frame
  bool planeOfB = false;  ///< who owns the plane
  bool closest = false;   ///< the plane is that between closest points, not a face
  std::uint32_t faces = 0;
  Vec3 planeNormal = Vec3::UnitZ();   ///< [1] outward, owner's frame
  Vec3 planeTangent = Vec3::UnitX();  ///< [1] owner's frame
  double planeOffset = 0;             ///< [m] owner's frame

  bool hasEdges = false;  ///< the last point is that of the edges
  int edgeA = 0;
  int edgeB = 0;
  Vec3 middleA = Vec3::Zero();  ///< [m] of the edge, a's frame
  Vec3 middleB = Vec3::Zero();  ///< [m] b's frame
  double edgeSign = 1;          ///< that makes a's edge × b's edge point from b to a

  PileFrame plane;
  PileFrame edges;
  int count = 0;
  std::array<PilePoint, kMost> points;

  double moved = 0;       ///< [m] bound on the relative motion since it was built
  double separation = 0;  ///< [m] along the best axis when it was built
  double reach = 0;       ///< [m] points with smaller gaps were all taken

  const PileFrame& frameOf(int point) const { return hasEdges && point == count - 1 ? edges : plane; }
};

/// Builds the manifold anew, points with gaps up to `reach` [m]; impulses of features that stay are kept.
/// Returns false, and leaves no points, if the boxes are farther apart: separation says how far at least.
bool buildManifold(const PileBody& a, const PileBody& b, double reach, PileManifold& manifold);
bool buildManifold(const PileBody& a, const Wall& wall, double reach, PileManifold& manifold);

/// Gaps, points and directions at the bodies' present poses.
void refreshManifold(const PileBody& a, const PileBody& b, PileManifold& manifold);
void refreshManifold(const PileBody& a, const Wall& wall, PileManifold& manifold);

/// Bound [m] on what the boxes move past each other in h [s], as seen from a.
double relativeMotion(const PileBody& a, const PileBody& b, double h);

/// The deepest overlap by all 15 axes, or of a box and a wall [m]; 0 if they do not.
double overlapOf(const PileBody& a, const PileBody& b);
double overlapOf(const PileBody& a, const Wall& wall);

}  // namespace careen
