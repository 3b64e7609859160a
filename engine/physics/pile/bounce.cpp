// Restitution of a pile.
#include <algorithm>

#include "physics/pile/pile.h"

namespace careen {
namespace {

constexpr int kBounceSweeps = 20;

}  // namespace

// New impacts separate with e times their approach speed: a second solve after the motion, at the new
// positions (otherwise the angular momentum about each other is not conserved), starting from the impulses of
// the first.
void Pile::bounce() {
  const bool any = std::any_of(bounces_.begin(), bounces_.end(),
                               [&](const Bounce& each) { return solver_.normalImpulse(each.row) > 0; });
  if (!any) {
    return;
  }
  refreshNear();
  solver_.begin(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const PileBody& body = bodies_[i];
    solver_.setBody(static_cast<int>(i), body, tell_ * body.length / h_);
    if (!body.still()) {
      solver_.velocity(static_cast<int>(i)) = body.velocity;
      solver_.omega(static_cast<int>(i)) = body.omega;
    }
  }
  for (const int slot : near_) {
    const PileManifold& manifold = manifolds_[at(slot)];
    const bool hasWall = manifold.b.isWall();
    const Vec3 apart =
        hasWall ? Vec3(Vec3::Zero()) : Vec3(bodies_[at(manifold.a)].position - bodyAt(manifold.b).position);
    bool begun = false;
    for (int k = 0; k < manifold.count; ++k) {
      const PilePoint& point = manifold.points[at(k)];
      if (point.row < 0) {
        continue;
      }
      if (!begun) {
        solver_.beginManifold(manifold.a, manifold.b, manifold.friction);
        begun = true;
      }
      solver_.add({.armA = point.world,
                   .armB = point.world + apart,
                   .frame = manifold.frameOf(k),
                   .bound = -std::max(0.0, point.gap) / h_,
                   .normalImpulse = point.normalImpulse,
                   .tangential1 = point.tangential1,
                   .tangential2 = point.tangential2});
    }
  }
  solver_.link();
  for (const Bounce& each : bounces_) {
    if (solver_.normalImpulse(each.row) > 0) {
      solver_.setBound(each.row, each.speed);
      solver_.wakeRow(each.row);
    }
  }
  figures_.solves += solver_.solve(kBounceSweeps, true);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (solver_.pushed(static_cast<int>(i))) {
      takeVelocity(bodies_[i], static_cast<int>(i));
      deriveOmega(bodies_[i]);
    }
  }
}

// Updates gaps to the current poses, without rebuilding.
void Pile::refreshNear() {
  for (const int slot : near_) {
    PileManifold& manifold = manifolds_[at(slot)];
    const PileBody& a = bodies_[at(manifold.a)];
    if (manifold.b.isWall()) {
      refreshManifold(a, wallAt(manifold.b), manifold);
    } else {
      refreshManifold(a, bodyAt(manifold.b), manifold);
    }
  }
}

}  // namespace careen
