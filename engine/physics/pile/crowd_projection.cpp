// What pushes bodies apart that are deep in each other.
#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

#include "physics/pile/crowd.h"

namespace careen {
namespace {

constexpr int kPasses = 32;
constexpr int kMendingPasses = 3;
constexpr int kLongestPause = 15;  // steps in which mending, which failed again and again, is not tried
// After so many passes [1] of the tolerance is enough: less than what makes a step be taken again.
constexpr int kFewPasses = 2;
constexpr double kDeepEnough = 1.45;
// No more are taken if so many gain less than [1]. Those after the first ones cost more: they wait for what
// is still deep the next time, after most of it has moved on.
constexpr int kPatience = 4;
constexpr int kPatienceAtFirst = 2;
constexpr double kGain = 0.1;
constexpr double kFar = 4;  // [1] of the tolerance: displacement that may lead through other bodies

}  // namespace

void Crowd::beginProjection(Aim aim) {
  projection_.begin(
      bodies_, manifolds_, near_,
      [this](PileManifold& manifold, bool first) { refreshGaps(manifold, first); },
      aim == Aim::kApart ? PileProjection::TakeBack()
                         : [this](PileManifold& manifold) { takeBackGaps(manifold); });
}

// To where its bodies are; `first` after a step.
void Crowd::refreshGaps(PileManifold& manifold, bool first) {
  const PileBody& a = bodies_[at(manifold.a)];
  if (manifold.b.isWall()) {
    refreshManifold(a, wallAt(manifold.b), manifold);
    return;
  }
  const PileBody& b = bodyAt(manifold.b);
  if (manifold.moved + (first ? relativeMotion(a, b, h_) : 0) > rebuildAfter(manifold.length)) {
    ++std::atomic_ref<std::int64_t>(figures_.rebuilt);
    buildManifold(a, b, manifold.reach, manifold);
  } else {
    refreshManifold(a, b, manifold);
  }
}

void Crowd::takeBackGaps(PileManifold& manifold) const {
  const PileBody& a = start_[at(manifold.a)];
  if (manifold.b.isWall()) {
    refreshManifold(a, wallAt(manifold.b), manifold);
  } else {
    refreshManifold(a, start_[at(manifold.b.body())], manifold);
  }
}

void Crowd::projectAll() {
  beginProjection(Aim::kApart);
  projection_.lookAtAll();
  project(kPasses);
}

// By those that the projection looked at; who is held, until none is deeper than before the step. Returns the
// deepest gap that is left [m]: no deeper than it was.
// Where boxes are wedged passes can lead away from the solution, and what is left takes ways that are many
// times as long.
double Crowd::project(int passes) {
  const bool holds = projection_.holds();
  const int patience = holds ? passes : left_ > kDeepEnough * tolerance_ ? kPatience : kPatienceAtFirst;
  const double enoughDepth = std::max(kDeepEnough * tolerance_, holds ? deepestBefore() : 0);
  double deepest = projection_.deepest();
  double least = deepest;
  double reached = deepest;
  int since = 0;
  for (int pass = 0; pass < passes; ++pass) {
    if (deepest <= least) {
      least = deepest;
      keepPlaces();
    }
    if (least < (1 - kGain) * reached) {
      reached = least;
      since = pass;
    }
    const bool enough =
        pass - since >= patience || (pass >= (holds ? 1 : kFewPasses) && deepest <= enoughDepth);
    if (enough || !projection_.pass(pass)) {
      break;
    }
    ++figures_.projections;
    projected_ += projection_.farthest();
    for (const int body : projection_.moved()) {
      before_[at(body)].pushed = before_[at(body)].projected = true;
    }
    deepest = projection_.deepest();
  }
  if (deepest > least) {
    restorePlaces();
    projection_.lookAgain();
    deepest = projection_.deepest();
  }
  left_ = deepest;
  return deepest;
}

// [m] Of those that are deep, before the step.
double Crowd::deepestBefore() const {
  double deepest = 0;
  for (std::size_t k = 0; k < isDeep_.size(); ++k) {
    deepest = isDeep_[k] != 0 ? std::max(deepest, depthBefore(pairs_.pairs()[k])) : deepest;
  }
  return deepest;
}

void Crowd::keepPlaces() {
  kept_.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const PileBody& body = bodies_[i];
    kept_[i] = {
        .position = body.position, .attitude = body.attitude, .path = body.path, .turned = body.turned};
  }
}

// The way back is as long as that there.
void Crowd::restorePlaces() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    PileBody& body = bodies_[i];
    if (body.path > kept_[i].path) {
      body.position = kept_[i].position;
      setAttitude(body, kept_[i].attitude);
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

// At what newDepth() found deep, of those that are near in this step; returns whether all were.
bool Crowd::lookAtDeep(Aim aim) {
  beginProjection(aim);
  bool all = true;
  std::size_t n = 0;
  for (std::size_t k = 0; k < looked_.size(); ++k) {
    const bool isNear = looked_[k] == Looked::kNear;
    if (isDeep_[k] != 0 && isNear) {
      projection_.lookAt(n);
    }
    all = all && (isNear || isDeep_[k] == 0);
    n += isNear ? 1 : 0;
  }
  return all;
}

// Pushes apart the few that are deep after a step; returns whether that went well: on their way, too, and not
// through others. In a jam, where it fails again and again, it is not tried each time.
bool Crowd::mend() {
  if (mendingWait_ > 0) {
    --mendingWait_;
    return false;
  }
  if (tryToMend()) {
    mendingPause_ = 0;
    return true;
  }
  mendingWait_ = std::exchange(mendingPause_, std::min(2 * mendingPause_ + 1, kLongestPause));
  return false;
}

bool Crowd::tryToMend() {
  if (!lookAtDeep(Aim::kApart) || project(kMendingPasses) > kDeepEnough * tolerance_) {
    return false;
  }
  findTurns();
  const std::vector<PilePair>& pairs = pairs_.pairs();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (isDeep_[k] != 0 && depthNow(pairs[k]) > 0) {
      return false;
    }
  }
  return projected_ <= kFar * tolerance_ || deepestOnWay() == 0;
}

// The same as far as it can be done. Where that does little, or where bodies would have to go through others
// to where they are pushed, all are held as they were before the step, or else left where they came. Returns
// how deep [m] any are then, on their way, too.
double Crowd::projectOnWay() {
  const std::vector<PileBody> unpushed = bodies_;
  const double before = projected_;
  double deep = 0;
  for (const Aim aim : {Aim::kApart, Aim::kHold}) {
    projected_ = before;
    lookAtDeep(aim);
    deep = projection_.deepest();
    const double atEnd = project(kPasses);
    left_ = std::max(atEnd, projected_ > kFar * tolerance_ ? deepestOnWay() : 0);
    const double enough = std::max((1 - kGain) * deep, kDeepEnough * tolerance_);
    if (left_ <= (aim == Aim::kApart ? enough : deep)) {
      return left_;
    }
    bodies_ = unpushed;
    rebuildNear();
  }
  return left_ = deep;
}

// [m] Of what was pushed; 0 if it is not too much.
double Crowd::deepestOnWay() {
  findTurns();
  double deepest = 0;
  for (const PilePair& pair : pairs_.pairs()) {
    if (!pair.b.isWall() && (before_[at(pair.a)].projected || before_[at(pair.b.body())].projected) &&
        !isClear(pair)) {
      const int axis = pair.slot < 0 ? -1 : manifolds_[at(pair.slot)].axis;
      const double atEnd = gapAtEnd(pair.a, pair.b.body(), axis);
      deepest = std::max(deepest, depthWithin(pair.a, pair.b.body(), axis, atEnd));
    }
  }
  return deepest;
}

}  // namespace careen
