// How deep bodies are in each other, and what undoes it within a step.
#include <algorithm>
#include <atomic>
#include <limits>

#include "physics/pile/axes.h"
#include "physics/pile/crowd.h"
#include "physics/pile/depth_search.h"

namespace careen {
namespace {

constexpr double kDeep = 1.5;       // [1] of the tolerance: new penetration that is projected at once
constexpr double kMostDeep = 1.75;  // [1] the same for any
// Of what the projection tolerates: penetration from which bodies are shifted, what is left of it, so that
// contacts persist, and the change that re-solves neighbours.
constexpr double kShifted = 0.8;
constexpr double kShiftedTo = 0.5;
constexpr double kShiftChange = 0.25;
constexpr int kShiftSweeps = 60;
// Within a step, boxes are looked at where one may have moved by so much [1] of the tolerance relative to the
// other, at parts of it as short as that [1].
constexpr double kSwing = 8;
constexpr double kShortestLook = 0.0625;

}  // namespace

// Shifts that undo the penetration which the step would end with at the rates found: Gauss–Seidel stops
// early, and gaps below zero are no bound to it. They need no rows of their own, unlike a projection. None
// where they stop so early, too, that others go deeper: among wedged boxes.
void Crowd::findShifts() {
  solver_.beginShifts(h_);
  std::atomic<bool> any = false;
  const double before = team_->largest(near_.size(), [&](std::size_t first, std::size_t last) {
    double most = 0;
    for (std::size_t n = first; n < last; ++n) {
      const PileManifold& manifold = manifolds_[at(near_[n])];
      const double tolerated = projection_.tolerated(manifold.length);
      for (int k = 0; k < manifold.count; ++k) {
        const PilePoint& point = manifold.points[at(k)];
        if (point.row < 0) {
          continue;
        }
        const double lacks =
            solver_.addToShiftBound(point.row, -(point.gap + point.curved + kShiftedTo * tolerated));
        if (lacks > (kShifted - kShiftedTo) * tolerated) {
          any = true;
          solver_.wakeRow(point.row);
        }
        most = std::max(most, lacks);
      }
    }
    return most;
  });
  shifts_ = any;
  if (!shifts_) {
    return;
  }
  figures_.solves += solver_.shift(kShiftSweeps, kShiftChange * tolerance_);
  shifts_ = solver_.mostLacking() <= before;
  if (!shifts_) {
    return;
  }
  forNear([&](PileManifold& manifold, std::size_t) {
    manifold.moved += shiftOf(manifold.a) + (manifold.b.isWall() ? 0 : shiftOf(manifold.b.body()));
  });
}

// [m] How deep bodies went into each other and into walls in this step, if more than kDeep: the features of
// the manifolds of its start were not all that met. `isDeep_` says which are, or are deeper than kMostDeep,
// even if they were before; `undone_` is the deepest of the others.
double Crowd::newDepth() {
  const std::vector<PilePair>& pairs = pairs_.pairs();
  findTurns();
  isDeep_.assign(pairs.size(), 0);
  undone_ = 0;
  return team_->largest(pairs.size(), [&](std::size_t first, std::size_t last) {
    double deepestHere = 0;
    double undoneHere = 0;
    for (std::size_t k = first; k < last; ++k) {
      const PilePair& pair = pairs[k];
      const double depth = isClear(pair) ? 0 : depthNow(pair);
      if (depth == 0) {
        continue;
      }
      const bool grew = depth > depthBefore(pair) + 0.5 * tolerance_;
      deepestHere = grew ? std::max(deepestHere, depth) : deepestHere;
      if (grew || depth > kMostDeep * tolerance_) {
        isDeep_[k] = 1;
        if (pair.slot >= 0) {
          manifolds_[at(pair.slot)].moved = std::numeric_limits<double>::max();  // to be rebuilt
        }
      } else {
        undoneHere = std::max(undoneHere, depth);
      }
    }
    raiseTo(undone_, undoneHere);
    return deepestHere;
  });
}

// Of bodies in the step, and their paths up to its end.
void Crowd::findTurns() {
  turns_.resize(bodies_.size());
  forPlaces([&](std::size_t i) {
    const Quat by = bodies_[i].attitude * start_[i].attitude.conjugate();
    paths_[i] = bodies_[i].path;
    turns_[i] = bodies_[i].still() ? Vec3(Vec3::Zero()) : Vec3((by.w() < 0 ? -2 : 2) * by.vec());
  });
}

// [m] How far points of it were shifted in the last step, at the most.
double Crowd::shiftOf(int body) const {
  return shifts_ && solver_.isShifted(body)
             ? solver_.displacement(body).norm() + bodies_[at(body)].radius * solver_.turn(body).norm()
             : 0;
}

// [m] Overlap by all axes, 0 if it cannot be or is not more than kDeep.
double Crowd::depthNow(const PilePair& pair) const {
  const PileBody& a = bodies_[at(pair.a)];
  const PileBody* b = pair.b.isWall() ? nullptr : &bodyAt(pair.b);
  if ((a.still() && (b == nullptr || b->still())) || (pair.slot < 0 && pair.clear > 0 && wayLeft(pair) > 0)) {
    return 0;
  }
  const double motion = b == nullptr ? a.path - start_[at(pair.a)].path
                                     : relativeMotion(a, *b, h_) + shiftOf(pair.a) + shiftOf(pair.b.body());
  if (motion < tolerance_ && !startedDeep(pair)) {
    return 0;
  }
  if (b == nullptr) {
    const double depth = overlapOf(a, wallAt(pair.b));
    return depth > kDeep * tolerance_ ? depth : 0;
  }
  const int axis = pair.slot < 0 ? -1 : manifolds_[at(pair.slot)].axis;
  const double atEnd = gapAtEnd(pair.a, pair.b.body(), axis);
  const double deep = atEnd < -kDeep * tolerance_ ? overlapOf(a, *b) : 0;
  return std::max(deep, depthWithin(pair.a, pair.b.body(), axis, atEnd));
}

// [m] By how much points of b moved in the last step as seen from a, at the most, to first order.
double Crowd::wayOf(int b, int a) const {
  const auto wayOfCenter = [&](int body) -> Vec3 {
    return bodies_[at(body)].position - start_[at(body)].position;
  };
  const Vec3 apart = start_[at(b)].position - start_[at(a)].position;
  return (wayOfCenter(b) - wayOfCenter(a) - turns_[at(a)].cross(apart)).norm() +
         bodies_[at(b)].radius * (turns_[at(b)] - turns_[at(a)]).norm();
}

// [m] Of two boxes; of those no deeper than kDeep, a lower bound. The axis is that of their manifold, or −1.
double Crowd::gapAtEnd(int a, int b, int axis) const {
  const PileBody& bodyA = bodies_[at(a)];
  const PileBody& bodyB = bodies_[at(b)];
  return gapAbove(-kDeep * tolerance_, axis, bodyA, bodyA.axes, bodyB, bodyB.axes,
                  bodyA.middle() - bodyB.middle());
}

// Whether they do along that axis on a straight way: within it, its separation is lower than at the ends by
// what is of second order in their turns.
bool Crowd::staysApart(int a, int b, int axis) const {
  if (axis < 0) {
    return false;
  }
  const auto separation = [&](const PileBody& bodyA, const PileBody& bodyB) {
    return separationAlong(axis, bodyA, bodyA.axes, bodyB, bodyB.axes, bodyA.middle() - bodyB.middle());
  };
  const PileBody& fromA = start_[at(a)];
  const PileBody& fromB = start_[at(b)];
  const PileBody& toA = bodies_[at(a)];
  const PileBody& toB = bodies_[at(b)];
  const double turn = turns_[at(a)].norm() + turns_[at(b)].norm();
  const double way = (toA.position - toB.position - (fromA.position - fromB.position)).norm();
  const double lower = 0.25 * turn * (turn * (toA.radius + toB.radius) + way);
  return std::min(separation(fromA, fromB), separation(toA, toB)) - lower > -kDeep * tolerance_;
}

// [m] Overlap within the step, if more than kDeep: of features that are apart at both its ends. No gap
// changes by more than points move.
double Crowd::depthWithin(int a, int b, int axis, double atEnd) const {
  const double motion = wayOf(b, a);
  if (motion <= kSwing * tolerance_) {
    return 0;
  }
  if (staysApart(a, b, axis)) {
    return 0;
  }
  const auto gapAt = [&](double part) {
    const Pose poseA = between(at(a), part);
    const Pose poseB = between(at(b), part);
    return gapAbove(-kDeep * tolerance_, axis, bodies_[at(a)], poseA.worldFromBody, bodies_[at(b)],
                    poseB.worldFromBody, bodies_[at(a)].middleAt(poseA) - bodies_[at(b)].middleAt(poseB));
  };
  const DepthSearch search{
      .motion = motion, .deep = kDeep * tolerance_, .swing = kSwing * tolerance_, .shortest = kShortestLook};
  const double deepest = searchDepth(search, gapAt, gapAt(0), atEnd);
  return deepest > kDeep * tolerance_ ? deepest : 0;
}

// Whether a gap was below the tolerance before the step.
bool Crowd::startedDeep(const PilePair& pair) const {
  if (pair.slot < 0) {
    return false;
  }
  const PileManifold& manifold = manifolds_[at(pair.slot)];
  return std::any_of(manifold.points.begin(), manifold.points.begin() + manifold.count,
                     [&](const PilePoint& point) { return point.gap < -tolerance_; });
}

double Crowd::depthBefore(const PilePair& pair) const {
  const PileBody& a = start_[at(pair.a)];
  return pair.b.isWall() ? overlapOf(a, wallAt(pair.b)) : overlapOf(a, start_[at(pair.b.body())]);
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
