// How deep bodies are in each other, and what undoes it within a step.
#include <algorithm>

#include "physics/pile/crowd.h"

namespace careen {
namespace {

constexpr double kDeep = 1.5;  // [1] of the tolerance: new penetration that is projected at once
// Of what the projection tolerates: penetration from which bodies are shifted, what is left of it, so that
// contacts persist, and the change that re-solves neighbours.
constexpr double kShifted = 0.8;
constexpr double kShiftedTo = 0.5;
constexpr double kShiftChange = 0.25;
constexpr int kShiftSweeps = 20;

}  // namespace

// Shifts that undo the penetration which the step would end with at the rates found: Gauss–Seidel stops
// early, and gaps below zero are no bound to it. They need no rows of their own, unlike a projection.
void Crowd::findShifts() {
  shifts_ = false;
  for (const int slot : near_) {
    const PileManifold& manifold = manifolds_[at(slot)];
    const double tolerated = projection_.tolerated(manifold.length);
    for (int k = 0; k < manifold.count; ++k) {
      const PilePoint& point = manifold.points[at(k)];
      if (point.row < 0) {
        continue;
      }
      const double gap = point.gap + h_ * solver_.normalSpeed(point.row);
      solver_.setShiftBound(point.row, -(gap + kShiftedTo * tolerated));
      if (gap < -kShifted * tolerated) {
        shifts_ = true;
        solver_.wakeRow(point.row);
      }
    }
  }
  if (!shifts_) {
    return;
  }
  solver_.beginShifts();
  figures_.solves += solver_.shift(kShiftSweeps, kShiftChange * tolerance_);
  for (const int slot : near_) {
    PileManifold& manifold = manifolds_[at(slot)];
    for (const int body : {manifold.a, manifold.b.isWall() ? manifold.a : manifold.b.body()}) {
      manifold.moved +=
          solver_.displacement(body).norm() + bodies_[at(body)].radius * solver_.turn(body).norm();
    }
  }
}

// [m] How deep fast bodies went into each other and into walls in this step, if more than kDeep: the features
// of the manifolds of its start were not all that met.
double Crowd::newDepth() {
  double deepest = 0;
  for (const PilePair& pair : pairs_.pairs()) {
    const double depth = depthSince(pair);
    deepest = std::max(deepest, depth);
    if (depth > 0 && pair.slot >= 0) {
      manifolds_[at(pair.slot)].moved = std::numeric_limits<double>::max();  // to be rebuilt
    }
  }
  return deepest;
}

double Crowd::depthSince(const PilePair& pair) const {
  const PileBody& a = bodies_[at(pair.a)];
  const PileBody* b = pair.b.isWall() ? nullptr : &bodyAt(pair.b);
  const bool apart = pair.slot < 0 && a.path + (b == nullptr ? 0 : b->path) < pair.until;
  if (apart || (b == nullptr ? a.path - start_[at(pair.a)].path : relativeMotion(a, *b, h_)) < tolerance_) {
    return 0;
  }
  const double depth = b == nullptr ? overlapOf(a, wallAt(pair.b)) : overlapOf(a, *b);
  if (depth <= kDeep * tolerance_) {
    return 0;
  }
  const PileBody& start = start_[at(pair.a)];
  const double before =
      b == nullptr ? overlapOf(start, wallAt(pair.b)) : overlapOf(start, start_[at(pair.b.body())]);
  return depth > before + 0.5 * tolerance_ ? depth : 0;
}

double Crowd::penetration() const {
  double deepest = 0;
  for (const PilePair& pair : pairs_.pairs()) {
    const PileBody& a = bodies_[at(pair.a)];
    deepest =
        std::max(deepest, pair.b.isWall() ? overlapOf(a, wallAt(pair.b)) : overlapOf(a, bodyAt(pair.b)));
  }
  return deepest;
}

}  // namespace careen
