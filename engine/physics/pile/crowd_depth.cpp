#include "physics/pile/crowd_depth.h"

#include <algorithm>
#include <limits>

#include "physics/pile/axes.h"
#include "physics/pile/depth_search.h"

namespace careen {
namespace {

constexpr double kMostDeep = 1.75;  // [1] of the tolerance: any penetration that is projected at once
// Within a step, boxes are looked at where one may have moved by so much [1] of the tolerance relative to the
// other, at parts of it as short as that [1].
constexpr double kSwing = 8;
constexpr double kShortestLook = 0.0625;

}  // namespace

double CrowdDepth::find() {
  const std::vector<PilePair>& pairs = contacts_.pairs();
  findTurns();
  isDeep_.assign(pairs.size(), 0);
  undone_ = 0;
  return members_.team->largest(pairs.size(), [&](std::size_t first, std::size_t last) {
    double deepestHere = 0;
    double undoneHere = 0;
    for (std::size_t k = first; k < last; ++k) {
      const PilePair& pair = pairs[k];
      const double depth = contacts_.isClear(pair) ? 0 : now(pair);
      if (depth == 0) {
        continue;
      }
      const bool grew = depth > before(pair) + 0.5 * members_.tolerance;
      deepestHere = grew ? std::max(deepestHere, depth) : deepestHere;
      if (grew || depth > kMostDeep * members_.tolerance) {
        isDeep_[k] = 1;
        if (pair.slot >= 0) {
          contacts_[pair.slot].moved = std::numeric_limits<double>::max();  // to be rebuilt
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
void CrowdDepth::findTurns() {
  contacts_.endPaths();
  turns_.resize(members_.size());
  members_.forEach([&](std::size_t i) {
    const Quat by = members_[i].attitude * members_.start[i].attitude.conjugate();
    turns_[i] = members_[i].stays() ? Vec3(Vec3::Zero()) : Vec3((by.w() < 0 ? -2 : 2) * by.vec());
  });
}

double CrowdDepth::now(const PilePair& pair) const {
  const PileBody& a = members_[pair.a];
  const PileBody& b = members_[pair.b];
  if ((a.stays() && b.stays()) || (pair.slot < 0 && pair.clear > 0 && contacts_.wayLeft(pair) > 0)) {
    return 0;
  }
  const double motion = b.isBox() ? relativeMotion(a, b, members_.h) + members_.ways[at(pair.a)].shifted +
                                        members_.ways[at(pair.b)].shifted
                                  : a.path - members_.start[at(pair.a)].path +
                                        (b.isDriven() ? relativeMotion(a, b, members_.h) : 0);
  if (motion < members_.tolerance && !startedDeep(pair)) {
    return 0;
  }
  const double atEnd = gapAtEnd(pair);
  const double deep = atEnd < -kDeep * members_.tolerance ? overlap(pair) : 0;
  return std::max(deep, within(pair, atEnd));
}

double CrowdDepth::onWay(const PilePair& pair) const { return within(pair, gapAtEnd(pair)); }

// [m] By how much points of b moved in the last step as seen from a, at the most, to first order.
double CrowdDepth::wayOf(int b, int a) const {
  const auto wayOfCenter = [&](int body) -> Vec3 {
    return members_[body].position - members_.start[at(body)].position;
  };
  const Vec3 apart = members_.start[at(b)].position - members_.start[at(a)].position;
  return (wayOfCenter(b) - wayOfCenter(a) - turns_[at(a)].cross(apart)).norm() +
         members_[b].radius * (turns_[at(b)] - turns_[at(a)]).norm();
}

// [m] Of those no deeper than kDeep, a lower bound.
double CrowdDepth::gapAtEnd(const PilePair& pair) const {
  return withBoxes(members_[pair.a], pair.boxA, members_[pair.b], pair.boxB,
                   [&](const PileBox& a, const PileBox& b) {
                     return gapAbove(-kDeep * members_.tolerance, contacts_.axisOf(pair), a, b);
                   });
}

// Whether they do along the axis of their manifold on a straight way: within it, its separation is lower than
// at the ends by what is of second order in their turns.
bool CrowdDepth::staysApart(const PilePair& pair) const {
  const int axis = contacts_.axisOf(pair);
  if (axis < 0) {
    return false;
  }
  const auto separation = [&](const PileBody& bodyA, const PileBody& bodyB) {
    return withBoxes(bodyA, pair.boxA, bodyB, pair.boxB, [&](const PileBox& a, const PileBox& b) {
      return separationAlong(axis, a, b, a.middle() - b.middle());
    });
  };
  const PileBody& fromA = members_.start[at(pair.a)];
  const PileBody& fromB = members_.start[at(pair.b)];
  const PileBody& toA = members_[pair.a];
  const PileBody& toB = members_[pair.b];
  const double turn = turns_[at(pair.a)].norm() + turns_[at(pair.b)].norm();
  const double way = (toA.position - toB.position - (fromA.position - fromB.position)).norm();
  const double lower = 0.25 * turn * (turn * (toA.radius + toB.radius) + way);
  return std::min(separation(fromA, fromB), separation(toA, toB)) - lower > -kDeep * members_.tolerance;
}

// [m] Overlap within the step, if more than kDeep: of features that are apart at both its ends. No gap
// changes by more than points move.
double CrowdDepth::within(const PilePair& pair, double atEnd) const {
  const PileBody& a = members_[pair.a];
  const PileBody& b = members_[pair.b];
  const double motion = b.isBox() ? wayOf(pair.b, pair.a) : 0;
  if (motion <= kSwing * members_.tolerance) {
    return 0;
  }
  if (staysApart(pair)) {
    return 0;
  }
  const auto gapAt = [&](double part) {
    return gapAboveOfBoxes(-kDeep * members_.tolerance, contacts_.axisOf(pair),
                           boxOf(a, pair.boxA, members_.between(at(pair.a), part)),
                           boxOf(b, pair.boxB, members_.between(at(pair.b), part)));
  };
  const DepthSearch search{.motion = motion,
                           .deep = kDeep * members_.tolerance,
                           .swing = kSwing * members_.tolerance,
                           .shortest = kShortestLook};
  const double deepest = searchDepth(search, gapAt, gapAt(0), atEnd);
  return deepest > kDeep * members_.tolerance ? deepest : 0;
}

// Whether a gap was below the tolerance before the step.
bool CrowdDepth::startedDeep(const PilePair& pair) const {
  if (pair.slot < 0) {
    return false;
  }
  const PileManifold& manifold = contacts_[pair.slot];
  return std::any_of(manifold.points.begin(), manifold.points.begin() + manifold.count,
                     [&](const PilePoint& point) { return point.gap < -members_.tolerance; });
}

double CrowdDepth::overlap(const PilePair& pair, const std::vector<PileBody>& bodies) const {
  return withBoxes(bodies[at(pair.a)], pair.boxA, bodies[at(pair.b)], pair.boxB,
                   [](const PileBox& a, const PileBox& b) { return overlapOf(a, b); });
}

bool CrowdDepth::anyIsDeep() const { return std::find(isDeep_.begin(), isDeep_.end(), 1) != isDeep_.end(); }

double CrowdDepth::deepestBefore() const {
  double deepest = 0;
  for (std::size_t k = 0; k < isDeep_.size(); ++k) {
    deepest = isDeep(k) ? std::max(deepest, before(contacts_.pairs()[k])) : deepest;
  }
  return deepest;
}

}  // namespace careen
