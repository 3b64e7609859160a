#include "physics/pile/crowd_apart.h"

#include <algorithm>
#include <array>
#include <utility>

namespace careen {
namespace {

constexpr double kProjected = 3;  // longest steps between two projections
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
constexpr double kFarAway = 4;  // [1] of the tolerance: displacement that may lead through other bodies

}  // namespace

CrowdApart::CrowdApart(CrowdMembers& members, CrowdContacts& contacts, CrowdArticulations& articulations,
                       CrowdDepth& depth, CrowdMemory& memory)
    : members_(members),
      contacts_(contacts),
      articulations_(articulations),
      depth_(depth),
      memory_(memory),
      projection_(members.tolerance, members.team) {}

void CrowdApart::beginProjection(Aim aim) {
  projection_.begin(
      members_.bodies, contacts_.manifolds(), contacts_.near(),
      [this](PileManifold& manifold, PileProjection::Look look) { refreshGaps(manifold, look); },
      aim == Aim::kApart ? PileProjection::TakeBack()
                         : [this](PileManifold& manifold) { contacts_.refresh(manifold, members_.start); });
}

// To where its bodies are; for the first time after a step, or again.
void CrowdApart::refreshGaps(PileManifold& manifold, PileProjection::Look look) const {
  const PileBody& a = members_[manifold.a];
  const PileBody& b = members_[manifold.b];
  if (b.isBox() &&  // else it has all corners
      manifold.moved + (look == PileProjection::Look::kFirst ? relativeMotion(a, b, members_.h) : 0) >
          contacts_.rebuildAfter(manifold.length)) {
    buildBetween(a, b, manifold);
  } else {
    refreshBetween(a, b, manifold);
  }
}

bool CrowdApart::projectAll() {
  memory_.sinceProjection += members_.h;
  if (memory_.sinceProjection < kProjected * members_.longestStep()) {
    return false;
  }
  beginProjection(Aim::kApart);
  projection_.lookAtAll();
  project(kPasses);
  memory_.sinceProjection = 0;
  return true;
}

// By those that the projection looked at; who is held, until none is deeper than before the step. Returns the
// deepest gap that is left [m]: no deeper than it was.
// Where boxes are wedged passes can lead away from the solution, and what is left takes ways that are many
// times as long.
double CrowdApart::project(int passes) {
  const bool holds = projection_.holds();
  const int patience = holds                                      ? passes
                       : left_ > kDeepEnough * members_.tolerance ? kPatience
                                                                  : kPatienceAtFirst;
  const double enoughDepth = std::max(kDeepEnough * members_.tolerance, holds ? depth_.deepestBefore() : 0);
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
    ++passes_;
    projected_ += projection_.farthest();
    for (const int body : projection_.moved()) {
      members_.ways[at(body)].pushed = members_.ways[at(body)].projected = true;
    }
    closeJoints();
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

// Of what touches bodies that are joined: no deeper than a projection leaves it.
void CrowdApart::addGapsOfJoined(CrowdProblem& displacements) {
  for (const int slot : contacts_.near()) {
    PileManifold& manifold = contacts_[slot];
    if (!articulations_.isJoined(manifold.a) && !articulations_.isJoined(manifold.b)) {
      continue;
    }
    contacts_.refresh(manifold);
    const double left = PileProjection::kLeft * projection_.tolerated(manifold.length);
    const Vec3 apart = members_.apart(manifold.a, manifold.b);
    for (int k = 0; k < manifold.count; ++k) {
      const PilePoint& point = manifold.points[at(k)];
      if (point.gap < kFarAway * members_.tolerance) {
        const std::array<Vec3, 3> axes = manifold.frameOf(k).axes();
        const int a = displacements.include(manifold.a, Vec3::Zero(), Vec3::Zero());
        const int b = displacements.include(manifold.b, Vec3::Zero(), Vec3::Zero());
        displacements.add({.a = a, .b = b, .target = {-(point.gap + left), 0, 0}},
                          pointSide(axes, point.world, 1), pointSide(axes, point.world + apart, -1), {});
      }
    }
  }
}

// What joints that are closed again do to other gaps shows in the next pass.
void CrowdApart::closeJoints() {
  if (!articulations_.any() ||
      !articulations_.close([this](CrowdProblem& displacements) { addGapsOfJoined(displacements); })) {
    return;
  }
  contacts_.displaced(articulations_.closedBy());
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (articulations_.closedBy()[i] > 0) {
      members_.ways[i].pushed = members_.ways[i].projected = true;
    }
  }
  projection_.lookAgain();
}

void CrowdApart::keepPlaces() {
  kept_.resize(members_.size());
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const PileBody& body = members_[i];
    kept_[i] = {
        .position = body.position, .attitude = body.attitude, .path = body.path, .turned = body.turned};
  }
}

// The way back is as long as that there.
void CrowdApart::restorePlaces() {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    PileBody& body = members_[i];
    if (body.path > kept_[i].path) {
      body.position = kept_[i].position;
      setAttitude(body, kept_[i].attitude);
      body.path += body.path - kept_[i].path;
      body.turned += body.turned - kept_[i].turned;
    }
  }
  contacts_.rebuildNear();
}

// At what is deep, of those that are near in this step; returns whether all were.
bool CrowdApart::lookAtDeep(Aim aim) {
  beginProjection(aim);
  bool all = true;
  std::size_t n = 0;
  for (std::size_t k = 0; k < contacts_.pairs().size(); ++k) {
    const bool isNear = contacts_.isNear(k);
    if (depth_.isDeep(k) && isNear) {
      projection_.lookAt(n);
    }
    all = all && (isNear || !depth_.isDeep(k));
    n += isNear ? 1 : 0;
  }
  return all;
}

bool CrowdApart::mend() {
  if (memory_.mendingWait > 0) {
    --memory_.mendingWait;
    return false;
  }
  if (tryToMend()) {
    memory_.mendingPause = 0;
    return true;
  }
  memory_.mendingWait =
      std::exchange(memory_.mendingPause, std::min(2 * memory_.mendingPause + 1, kLongestPause));
  return false;
}

bool CrowdApart::tryToMend() {
  if (!lookAtDeep(Aim::kApart) || project(kMendingPasses) > kDeepEnough * members_.tolerance) {
    return false;
  }
  depth_.findTurns();
  const std::vector<PilePair>& pairs = contacts_.pairs();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (depth_.isDeep(k) && depth_.now(pairs[k]) > 0) {
      return false;
    }
  }
  return projected_ <= kFarAway * members_.tolerance || deepestOnWay() == 0;
}

double CrowdApart::projectOnWay() {
  const std::vector<PileBody> unpushed = members_.bodies;
  const double before = projected_;
  double deep = 0;
  for (const Aim aim : {Aim::kApart, Aim::kHold}) {
    projected_ = before;
    lookAtDeep(aim);
    deep = projection_.deepest();
    const double atEnd = project(kPasses);
    left_ = std::max(atEnd, projected_ > kFarAway * members_.tolerance ? deepestOnWay() : 0);
    const double enough = std::max((1 - kGain) * deep, kDeepEnough * members_.tolerance);
    if (left_ <= (aim == Aim::kApart ? enough : deep)) {
      return left_;
    }
    members_.bodies = unpushed;
    contacts_.rebuildNear();
  }
  return left_ = deep;
}

// [m] Of what was pushed; 0 if it is not too much.
double CrowdApart::deepestOnWay() {
  depth_.findTurns();
  double deepest = 0;
  for (const PilePair& pair : contacts_.pairs()) {
    if ((members_.ways[at(pair.a)].projected || members_.ways[at(pair.b)].projected) &&
        !contacts_.isClear(pair)) {
      deepest = std::max(deepest, depth_.onWay(pair));
    }
  }
  return deepest;
}

}  // namespace careen
