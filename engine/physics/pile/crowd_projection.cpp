// What pushes bodies apart that are deep in each other.
#include <algorithm>
#include <atomic>
#include <limits>

#include "physics/pile/crowd.h"

namespace careen {
namespace {

constexpr int kPasses = 32;
// After so many passes [1] of the tolerance is enough: less than what makes a step be taken again.
constexpr int kFewPasses = 2;
constexpr double kDeepEnough = 1.45;
// No more are taken if so many gain less than [1]. Those after the first ones cost more: they wait for what
// is still deep the next time, after most of it has moved on.
constexpr int kPatience = 4;
constexpr int kPatienceAtFirst = 2;
constexpr double kGain = 0.1;
constexpr int kMostParts = 8;
constexpr double kFar = 4;  // [1] of the tolerance: displacement that may lead through other bodies

}  // namespace

// Returns the deepest gap that is left [m]: no deeper than `deepest`, which refreshDepth() found. Where boxes
// are wedged passes can lead away from the solution, and what is left takes ways that are many times as long.
double Crowd::project(double deepest) {
  const int patience = left_ > kDeepEnough * tolerance_ ? kPatience : kPatienceAtFirst;
  double least = deepest;
  double reached = deepest;
  int since = 0;
  for (int pass = 0; pass < kPasses; ++pass) {
    if (deepest <= least) {
      least = deepest;
      keepPlaces();
    }
    if (least < (1 - kGain) * reached) {
      reached = least;
      since = pass;
    }
    const bool enough =
        pass - since >= patience || (pass >= kFewPasses && deepest < kDeepEnough * tolerance_);
    if (enough || !projection_.pass(bodies_, manifolds_, near_, pass)) {
      break;
    }
    ++figures_.projections;
    projected_ += projection_.farthest();
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      before_[i].pushed = before_[i].pushed || projection_.moved(static_cast<int>(i));
    }
    deepest = refreshDepth(false);
  }
  if (deepest > least) {
    restorePlaces();
    deepest = refreshDepth(true);
  }
  deepest_ = std::max(deepest_, deepest);
  left_ = deepest;
  return deepest;
}

// [m] Brings the gaps of all, or of those that the last pass moved, up to date; returns the deepest.
double Crowd::refreshDepth(bool all) {
  std::atomic<std::int64_t> rebuilt = 0;
  const double deepest = team_->largest(near_.size(), [&](std::size_t first, std::size_t last) {
    double deepestHere = 0;
    for (std::size_t n = first; n < last; ++n) {
      PileManifold& manifold = manifolds_[at(near_[n])];
      const PileBody& a = bodies_[at(manifold.a)];
      const PileBody* b = manifold.b.isWall() ? nullptr : &bodyAt(manifold.b);
      if (all || projection_.moved(manifold.a) || (b != nullptr && projection_.moved(manifold.b.body()))) {
        if (b == nullptr) {
          refreshManifold(a, wallAt(manifold.b), manifold);
        } else if (manifold.moved + (all ? relativeMotion(a, *b, h_) : 0) > rebuildAfter(manifold.length)) {
          ++rebuilt;
          buildManifold(a, *b, manifold.reach, manifold);
        } else {
          refreshManifold(a, *b, manifold);
        }
      }
      for (int k = 0; k < manifold.count; ++k) {
        deepestHere = std::max(deepestHere, -manifold.points[at(k)].gap);
      }
    }
    return deepestHere;
  });
  figures_.rebuilt += rebuilt;
  return deepest;
}

void Crowd::keepPlaces() {
  kept_.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const PileBody& body = bodies_[i];
    kept_[i] = {.place = {body.position, body.attitude}, .path = body.path, .turned = body.turned};
  }
}

// The way back is as long as that there.
void Crowd::restorePlaces() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    PileBody& body = bodies_[i];
    if (body.path > kept_[i].path) {
      body.position = kept_[i].place.position;
      setAttitude(body, kept_[i].place.attitude);
      body.path += body.path - kept_[i].path;
      body.turned += body.turned - kept_[i].turned;
    }
  }
  rebuildNear();
}

void Crowd::rebuildNear() {
  for (const int slot : near_) {
    manifolds_[at(slot)].moved = std::numeric_limits<double>::max();
  }
}

// The same, unless bodies would have to go deeper through each other to where they are pushed than they are.
double Crowd::projectOnWay() {
  const std::vector<PileBody> unpushed = bodies_;
  const double deep = refreshDepth(true);
  const double left = project(deep);
  if (findWay() <= deep) {
    return left;
  }
  bodies_ = unpushed;
  way_.clear();
  rebuildNear();
  return deep;
}

// On a long straight way to where they were pushed, bodies may come through each other: it leads through
// places then at which they were pushed apart, too, through as many as make it least deep. Returns how deep
// [m], 0 if not too much.
double Crowd::findWay() {
  double least = projected_ > kFar * tolerance_ ? deepestOnWay() : 0;
  for (int parts = 2; parts <= kMostParts && least > 0; parts *= 2) {
    std::vector<std::vector<Place>> way = divideWay(parts);
    way_.swap(way);
    const double deepest = deepestOnWay();
    if (deepest < least) {
      least = deepest;
    } else {
      way_.swap(way);
    }
  }
  return least;
}

// So many parts less one places on the present way, pushed apart.
std::vector<std::vector<Crowd::Place>> Crowd::divideWay(int parts) {
  const std::vector<PileBody> ends = bodies_;
  std::vector<std::vector<Place>> way(static_cast<std::size_t>(parts) - 1);
  for (std::size_t k = 0; k < way.size(); ++k) {
    bodies_ = ends;
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      poses.push_back(between(i, static_cast<double>(k + 1) / parts));
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      bodies_[i].position = poses[i].position;
      setAttitude(bodies_[i], Quat(poses[i].worldFromBody));
    }
    rebuildNear();
    project(refreshDepth(true));
    for (const PileBody& body : bodies_) {
      way[k].push_back({.position = body.position, .attitude = body.attitude});
    }
  }
  bodies_ = ends;
  rebuildNear();
  return way;
}

// [m] Of what was pushed; 0 if it is not too much.
double Crowd::deepestOnWay() {
  findTurns();
  double deepest = 0;
  for (const int slot : near_) {
    const PileManifold& manifold = manifolds_[at(slot)];
    if (!manifold.b.isWall() && (before_[at(manifold.a)].pushed || before_[at(manifold.b.body())].pushed)) {
      deepest = std::max(deepest, depthWithin(manifold.a, manifold.b.body(), manifold.axis,
                                              gapAtEnd(manifold.a, manifold.b.body(), manifold.axis)));
    }
  }
  return deepest;
}

}  // namespace careen
