#include "physics/pile/crowd_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "physics/pile/belts.h"

namespace careen {
namespace {

constexpr double kLookAhead = 6;  // longest steps for which a fat AABB should stay valid
constexpr double kUnseen = 2;     // [1] of the tolerance: motion after which other features may be deep

}  // namespace

CrowdContacts::CrowdContacts(CrowdMembers& members)
    : members_(members),
      pairs_(
          members.team, members.world.apart.empty() ? PilePairs::MayTouch() : [&members](int a, int b) {
            return mayTouch(members.world, static_cast<int>(members.listed[at(a)]),
                            static_cast<int>(members.listed[at(b)]));
          }) {}

void CrowdContacts::sort() {
  near_.clear();
  for (PilePair& pair : pairs_.pairs()) {
    if (pair.slot >= 0) {
      near_.push_back(std::exchange(pair.slot, static_cast<int>(near_.size())));
    }
  }
  sorted_.resize(near_.size());
  forNear([&](const PileManifold& manifold, std::size_t n) { sorted_[n] = manifold; });
  manifolds_.swap(sorted_);
  unused_.clear();
  pairs_.freed().clear();  // of members that left since the last step: slots of the old order
  near_.clear();
}

// One that sleeps may wake before its pairs are looked at.
void CrowdContacts::begin() {
  paths_.resize(members_.size());
  members_.forEach([&](std::size_t i) {
    PileBody& body = members_[i];
    const double fall = members_.h * (members_.h + body.behind) * members_.gravity;
    body.turning = body.stays() ? 0 : members_.h * body.radius * body.omega.norm();
    body.ahead = body.stays()
                     ? 0
                     : members_.h * (body.velocity.norm() + (members_.h + body.behind) * members_.gravity) +
                           body.turning;
    paths_[i] = body.path + (body.asleep ? fall : body.ahead);
  });
  pairs_.update(members_.bodies, gravityNow(members_.world, members_.time + 0.5 * members_.h), members_.h,
                std::max(members_.h, kLookAhead * members_.longestStep()));
  unused_.insert(unused_.end(), pairs_.freed().begin(), pairs_.freed().end());
  pairs_.freed().clear();
  looked_.assign(pairs_.pairs().size(), Looked::kNot);
  besideSleep_.clear();
}

void CrowdContacts::lookAtAll() {
  std::vector<PilePair>& pairs = pairs_.pairs();
  const int parts = members_.team->ranges(pairs.size());
  looking_.resize(at(parts));
  members_.team->run(parts, [&](int part) {
    Looking& looking = looking_[at(part)];
    looking.begun.clear();
    looking.left.clear();
    looking.besideSleep.clear();
    const std::size_t last = pairs.size() * (at(part) + 1) / looking_.size();
    for (std::size_t k = pairs.size() * at(part) / looking_.size(); k < last; ++k) {
      lookAt(k, looking);
    }
  });
  for (const Looking& looking : looking_) {
    besideSleep_.insert(besideSleep_.end(), looking.besideSleep.begin(), looking.besideSleep.end());
    for (const std::size_t k : looking.left) {
      unused_.push_back(std::exchange(pairs[k].slot, -1));
    }
    for (const auto& [k, manifold] : looking.begun) {
      keepManifold(pairs[k], manifold);
    }
  }
}

void CrowdContacts::lookAt(std::size_t k, Looking& looking) {
  PilePair& pair = pairs_.pairs()[k];
  if (isClear(pair) || looked_[k] != Looked::kNot || (members_[pair.a].stays() && members_[pair.b].stays())) {
    return;
  }
  const bool isNew = pair.slot < 0;
  PileManifold& manifold = isNew ? looking.tried : manifolds_[at(pair.slot)];
  looked_[k] = lookAt(pair, manifold);
  if (looked_[k] == Looked::kFar && !isNew) {
    looking.left.push_back(k);
  } else if (looked_[k] != Looked::kFar && isNew) {
    looking.begun.emplace_back(k, manifold);
  }
  if (looked_[k] == Looked::kNear &&
      (members_[pair.a].asleep || members_[pair.b].asleep || manifold.carries)) {
    looking.besideSleep.push_back(k);
  }
}

void CrowdContacts::listNear() {
  std::sort(besideSleep_.begin(), besideSleep_.end());
  near_.clear();
  for (std::size_t k = 0; k < looked_.size(); ++k) {
    if (isNear(k)) {
      near_.push_back(pairs_.pairs()[k].slot);
    }
  }
}

bool CrowdContacts::isClear(const PilePair& pair) const {
  return pair.slot < 0 && paths_[at(pair.a)] + paths_[at(pair.b)] < pair.until;
}

double CrowdContacts::wayLeft(const PilePair& pair) const {
  const PileBody& a = members_[pair.a];
  const PileBody& b = members_[pair.b];
  return pair.clear - wayNearer(a, b, pair.apart) - (a.turned + b.turned - pair.turned);
}

// [m] By how much they come nearer in this step, at the most, if nothing pushes them.
double CrowdContacts::wayAhead(const PilePair& pair) const {
  const PileBody& a = members_[pair.a];
  const PileBody& b = members_[pair.b];
  if (!b.isBox()) {
    return a.ahead;
  }
  const Vec3 relative =
      (a.stays() ? Vec3(Vec3::Zero()) : a.velocity) - (b.stays() ? Vec3(Vec3::Zero()) : b.velocity);
  return members_.h * (relative.norm() + (members_.h + a.behind + b.behind) * members_.gravity) + a.turning +
         b.turning;
}

double CrowdContacts::rebuildAfter(double length) const {
  return std::min(PileLengths::kRebuild * length, kUnseen * members_.tolerance);
}

// `manifold` is the pair's, or, if it has none, one to try.
CrowdContacts::Looked CrowdContacts::lookAt(PilePair& pair, PileManifold& manifold) const {
  const PileBody& a = members_[pair.a];
  const PileBody& b = members_[pair.b];
  if (pair.slot < 0) {
    const double left = pair.clear > 0 ? wayLeft(pair) : 0;
    if (wayAhead(pair) < left) {
      pair.until = a.path + b.path + left;
      return Looked::kFar;
    }
    beginManifold(pair, manifold);
  }
  const double motion = relativeMotion(a, b, members_.h);
  manifold.moved += motion;
  const double length = manifold.length;
  bool touching = manifold.count > 0;
  if (!touching || manifold.moved > rebuildAfter(length) ||
      manifold.moved + motion + 0.5 * PileLengths::kReach * length > manifold.reach) {
    manifold.reach = PileLengths::kReach * length + 1.5 * motion;
    touching = buildBetween(a, b, manifold);
  } else {
    refresh(manifold);
  }
  if (touching) {
    return manifold.count > 0 ? Looked::kNear : Looked::kBare;
  }
  pair.apart = a.position - b.position;
  pair.turned = a.turned + b.turned;
  // A wall that turns comes nearer by more, the farther from its axis: one that is driven is always looked at.
  pair.clear = b.isBox() || !b.isDriven() ? manifold.separation - PileLengths::kReach * length : 0;
  pair.until = a.path + b.path + pair.clear;
  return Looked::kFar;
}

void CrowdContacts::keepManifold(PilePair& pair, const PileManifold& manifold) {
  if (unused_.empty()) {
    unused_.push_back(static_cast<int>(manifolds_.size()));
    manifolds_.emplace_back();
  }
  pair.slot = unused_.back();
  unused_.pop_back();
  manifolds_[at(pair.slot)] = manifold;
}

void CrowdContacts::beginManifold(const PilePair& pair, PileManifold& manifold) const {
  manifold.clear();
  manifold.a = pair.a;
  manifold.b = pair.b;
  manifold.boxA = pair.boxA;
  manifold.boxB = pair.boxB;
  manifold.span = members_.span;
  const PileBody& a = members_[pair.a];
  const PileBody& b = members_[pair.b];
  manifold.material = touching(a.material, b.material);
  manifold.length = std::min(a.length, b.length);
}

void CrowdContacts::endPaths() {
  members_.forEach([&](std::size_t i) { paths_[i] = members_[i].path; });
}

void CrowdContacts::refresh(PileManifold& manifold, const std::vector<PileBody>& bodies) const {
  refreshBetween(bodies[at(manifold.a)], bodies[at(manifold.b)], manifold);
}

void CrowdContacts::rebuildNear() {
  for (const int slot : near_) {
    (*this)[slot].moved = std::numeric_limits<double>::max();
  }
}

void CrowdContacts::displaced(std::span<const double> by) {
  forNear([&](PileManifold& manifold, std::size_t) {
    manifold.moved += by[at(manifold.a)] + by[at(manifold.b)];
  });
}

void CrowdContacts::addPresentRows(const PileManifold& manifold, PileSolver& solver) const {
  const Vec3 apart = members_.apart(manifold.a, manifold.b);
  const ContactFrame* begun = nullptr;
  for (int k = 0; k < manifold.count; ++k) {
    const PilePoint& point = manifold.points[at(k)];
    if (point.row < 0) {
      continue;
    }
    const ContactFrame& frame = manifold.frameOf(k);
    if (begun != &frame) {
      const BeltBlock block =
          isOnBelt(members_, manifold)
              ? bodiesOnBelt(members_, manifold,
                             solver.addBelt(motionOfBelt(members_, manifold, frame, point)))
              : BeltBlock{.a = manifold.a, .b = manifold.b};
      solver.beginBlock(block.a, block.b, manifold.material.friction, frame, apart);
      begun = &frame;
    }
    solver.add({.arm = point.world,
                .bound = -std::max(0.0, point.gap) / members_.h,
                .normalImpulse = point.normalImpulse,
                .tangential1 = point.tangential1,
                .tangential2 = point.tangential2});
  }
}

}  // namespace careen
