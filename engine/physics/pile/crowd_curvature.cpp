#include "physics/pile/crowd_curvature.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

namespace careen {
namespace {

constexpr double kStraight = 0x1p-3;   // [1] of the tolerance: less is no bend
constexpr double kSag = 1;             // [1] of the tolerance: depth allowed in the middle of a step
constexpr double kParallel = 0x1p-20;  // [1] sine² of edges that have no common normal

// At the velocities found so far.
class Curvature {
 public:
  Curvature(const CrowdMembers& members, const PileSolver& solver)
      : members_(members), solver_(solver), bends_(members.size()) {
    members_.forEach([&](std::size_t i) {
      const double spin = members_[i].stays() ? 0 : solver_.omega(static_cast<int>(i)).squaredNorm();
      bends_[i] =
          0.5 * members_.h * members_.h * members_[i].radius * spin > kStraight * members_.tolerance ? 1 : 0;
    });
  }
  bool bends(const PileManifold& manifold) const {
    return bends_[at(manifold.a)] != 0 || bends_[at(manifold.b)] != 0;
  }
  double secondOrder(const PileManifold& manifold, int k) const;

 private:
  const CrowdMembers& members_;
  const PileSolver& solver_;
  std::vector<char> bends_;  // by place: its corners leave their tangents in this step
};

// [m/s²] Second derivative of a gap n·(xA − xB), x the points in contact as fixed in the bodies:
//     n·(aA − aB) + 2 ṅ·(vA − vB),   a = ω × (ω × r) + ω̇ × r;
// the third term, n̈·(xA − xB), is of the size of the gap. n turns with the body that owns the plane; the
// normal of an edge pair stays perpendicular to both edges: ṅ·e = −n·(ω × e).
double Curvature::secondOrder(const PileManifold& manifold, int k) const {
  const Vec3& arm = manifold.points[at(k)].world;
  const ContactFrame& frame = manifold.frameOf(k);
  const Vec3& n = frame.normal;
  const auto along = [&](int body, const Vec3& to) {  // of the point's acceleration
    if (bends_[at(body)] == 0) {
      return 0.0;
    }
    const Vec3& spin = solver_.omega(body);
    return dot(n, spin.cross(spin.cross(to)) + freeSpinRate(members_[body], spin).cross(to));
  };
  const int b = manifold.b;
  const PileBody& bodyA = members_[manifold.a];
  const PileBody& bodyB = members_[b];
  const Vec3& spinA = solver_.omega(manifold.a);
  const Vec3& spinB = solver_.omega(b);
  const Vec3 armB = arm + bodyA.position - bodyB.position;
  const Vec3 slip = solver_.velocity(manifold.a) + spinA.cross(arm) - solver_.velocity(b) - spinB.cross(armB);
  Vec3 turning = (manifold.planeOfB ? spinB : spinA).cross(n);
  if (&frame == &manifold.edges) {
    const Vec3 edgeA = boxOf(bodyA, manifold.boxA).axes.col(manifold.edgeMiddles.axisA);
    const Vec3 edgeB = boxOf(bodyB, manifold.boxB).axes.col(manifold.edgeMiddles.axisB);
    const double cosine = dot(edgeA, edgeB);
    const double ofEdgeA = -dot(n, spinA.cross(edgeA));
    const double ofEdgeB = -dot(n, spinB.cross(edgeB));
    const double perSquare = 1 / std::max(1 - cosine * cosine, kParallel);
    turning = perSquare * ((ofEdgeA - cosine * ofEdgeB) * edgeA + (ofEdgeB - cosine * ofEdgeA) * edgeB);
  }
  return along(manifold.a, arm) - along(b, armB) + 2 * dot(turning, slip);
}

}  // namespace

bool curveGaps(const CrowdMembers& members, CrowdContacts& contacts, PileSolver& solver) {
  const Curvature curvature(members, solver);
  const double h = members.h;
  std::atomic<bool> any = false;
  contacts.forNear([&](PileManifold& manifold, std::size_t) {
    const bool bends = curvature.bends(manifold);
    for (int k = 0; bends && k < manifold.count; ++k) {
      PilePoint& point = manifold.points[at(k)];
      if (point.row < 0) {
        continue;
      }
      point.curved = 0.5 * h * h * curvature.secondOrder(manifold, k);
      // An arc from surface to surface goes through what lies between.
      const double least =
          point.curved > 0
              ? -2 * (std::max(0.0, point.gap) + kSag * members.tolerance + 0.25 * point.curved) / h
              : -std::numeric_limits<double>::infinity();
      solver.addToBound(point.row, -point.curved / h, least);
      if (std::abs(point.curved) > kStraight * members.tolerance) {
        solver.wakeRow(point.row);
        any = true;
      }
    }
  });
  return any;
}

}  // namespace careen
