// Contacts of a crowd: broad and narrow phase, rows of the solver.
#include <algorithm>
#include <array>
#include <cmath>

#include "physics/pile/crowd.h"

namespace careen {
namespace {

constexpr double kLookAhead = 6;   // longest steps for which a fat AABB should stay valid
constexpr double kGrowth = 1.5;    // [1] largest growth of an impulse per step that the warm start accepts
constexpr double kBounceFrom = 4;  // [1] of gravity × step: slower impacts do not bounce
constexpr double kRounding = 0x1p-30;  // [1] of the fastest speed: slower impacts do not either
constexpr double kAllowance = 0.1;     // [1] of the smallest size: gaps that may close during a step
constexpr double kTogether = 3;        // [1] of the tolerance: points of one manifold that meet together
constexpr double kUnseen = 2;          // [1] of the tolerance: motion after which other features may be deep

}  // namespace

// Broad and narrow phase: pairs, and manifolds of the near ones. A contact that would push a sleeping body
// wakes its cluster, whose pairs are then tested too.
void Crowd::lookAround() {
  for (PileBody& body : bodies_) {
    body.turning = body.still() ? 0 : h_ * body.radius * body.omega.norm();
    body.ahead = body.still()
                     ? 0
                     : h_ * (body.velocity.norm() + (h_ + body.behind) * gravityMagnitude_) + body.turning;
  }
  pairs_.update(bodies_, world_.gravity, h_, std::max(h_, kLookAhead * longestStep()));
  unused_.insert(unused_.end(), pairs_.freed().begin(), pairs_.freed().end());
  pairs_.freed().clear();
  std::vector<PilePair>& pairs = pairs_.pairs();
  looked_.assign(pairs.size(), 0);
  for (bool woke = true; woke;) {
    woke = false;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      PilePair& pair = pairs[k];
      const PileBody& a = bodies_[at(pair.a)];
      const bool stillB = pair.b.isWall() || bodyAt(pair.b).still();
      if (looked_[k] != 0 || (a.still() && stillB)) {
        continue;
      }
      looked_[k] = lookAt(pair) ? 2 : 1;
      if (looked_[k] == 2 && (a.asleep || isAsleep(pair.b)) && wouldPush(pair, manifolds_[at(pair.slot)])) {
        wakeCluster(a.asleep ? a.cluster : bodyAt(pair.b).cluster);
        woke = true;
      }
    }
    if (woke) {
      wakeNeighbours();
    }
  }
  near_.clear();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (looked_[k] == 2) {
      near_.push_back(pairs[k].slot);
    }
  }
  std::fill(woken_.begin(), woken_.end(), 0);
  figures_.manifolds += static_cast<std::int64_t>(near_.size());
}

// [m] By how much the two may still come nearer than when they were last looked at, at the least, before
// there can be contact points.
double Crowd::wayLeft(const PilePair& pair) const {
  const PileBody& a = bodies_[at(pair.a)];
  if (pair.b.isWall()) {
    return pair.clear - std::abs(wallAt(pair.b).normal.dot(a.position - pair.apart)) -
           (a.turned - pair.turned);
  }
  const PileBody& b = bodyAt(pair.b);
  return pair.clear - (a.position - b.position - pair.apart).norm() - (a.turned + b.turned - pair.turned);
}

// [m] By how much they come nearer in this step, at the most, if nothing pushes them.
double Crowd::wayAhead(const PilePair& pair) const {
  const PileBody& a = bodies_[at(pair.a)];
  if (pair.b.isWall()) {
    return a.ahead;
  }
  const PileBody& b = bodyAt(pair.b);
  const Vec3 relative =
      (a.still() ? Vec3(Vec3::Zero()) : a.velocity) - (b.still() ? Vec3(Vec3::Zero()) : b.velocity);
  return h_ * (relative.norm() + (h_ + a.behind + b.behind) * gravityMagnitude_) + a.turning + b.turning;
}

// [m] Relative motion after which a manifold of boxes of that smallest size [m] is rebuilt.
double Crowd::rebuildAfter(double length) const {
  return std::min(PileLengths::kRebuild * length, kUnseen * tolerance_);
}

// Whether the pair has a manifold with points.
bool Crowd::lookAt(PilePair& pair) {
  ++figures_.pairs;
  const PileBody& a = bodies_[at(pair.a)];
  const bool hasWall = pair.b.isWall();
  if (pair.slot < 0 && pair.clear > 0 && wayAhead(pair) < wayLeft(pair)) {
    return false;
  }
  // Most that are near have no points: those are looked at in a place of their own, which stays in the cache.
  if (pair.slot < 0) {
    beginManifold(pair, tried_);
  }
  PileManifold& manifold = pair.slot < 0 ? tried_ : manifolds_[at(pair.slot)];
  const double motion = hasWall ? a.ahead : relativeMotion(a, bodyAt(pair.b), h_);
  manifold.moved += motion;
  const double length = manifold.length;
  bool touching = manifold.count > 0;
  if (!touching || manifold.moved > rebuildAfter(length) ||
      manifold.moved + motion + 0.5 * PileLengths::kReach * length > manifold.reach) {
    ++figures_.rebuilt;
    manifold.reach = PileLengths::kReach * length + 1.5 * motion;
    touching = hasWall ? buildManifold(a, wallAt(pair.b), manifold.reach, manifold)
                       : buildManifold(a, bodyAt(pair.b), manifold.reach, manifold);
  } else if (hasWall) {
    refreshManifold(a, wallAt(pair.b), manifold);
  } else {
    refreshManifold(a, bodyAt(pair.b), manifold);
  }
  if (!touching) {
    const PileBody* b = hasWall ? nullptr : &bodyAt(pair.b);
    pair.apart = b == nullptr ? a.position : Vec3(a.position - b->position);
    pair.turned = a.turned + (b == nullptr ? 0 : b->turned);
    pair.clear = manifold.separation - PileLengths::kReach * length;
    if (pair.slot >= 0) {
      unused_.push_back(pair.slot);
      pair.slot = -1;
    }
    return false;
  }
  const bool hasPoints = manifold.count > 0;
  if (pair.slot < 0) {
    keepManifold(pair, tried_);
  }
  return hasPoints;
}

void Crowd::keepManifold(PilePair& pair, const PileManifold& manifold) {
  if (unused_.empty()) {
    unused_.push_back(static_cast<int>(manifolds_.size()));
    manifolds_.emplace_back();
  }
  pair.slot = unused_.back();
  unused_.pop_back();
  manifolds_[at(pair.slot)] = manifold;
}

void Crowd::beginManifold(const PilePair& pair, PileManifold& manifold) const {
  manifold.clear();
  manifold.a = pair.a;
  manifold.b = pair.b;
  const PileBody& a = bodies_[at(pair.a)];
  const Material material =
      touching(a.material, pair.b.isWall() ? wallAt(pair.b).material : bodyAt(pair.b).material);
  manifold.friction = material.friction;
  manifold.restitution = material.restitution;
  manifold.length = pair.b.isWall() ? a.length : std::min(a.length, bodyAt(pair.b).length);
}

// Whether the moving body would push the sleeping one by more than the tolerated imbalance at rest, or strike
// it, if forces between them are part of the balance: how those change is known after the step.
bool Crowd::wouldPush(const PilePair& pair, const PileManifold& manifold) const {
  const PileBody& a = bodies_[at(pair.a)];
  const PileBody& b = bodyAt(pair.b);
  const auto speed = [&](const PileBody& body, const Vec3& arm) {
    return body.still() ? Vec3(Vec3::Zero())
                        : Vec3(body.velocity + h_ * world_.gravity + body.omega.cross(arm));
  };
  const double heavy = a.asleep ? a.inverseMass : b.inverseMass;
  const double light = a.asleep ? b.inverseMass : a.inverseMass;
  for (int k = 0; k < manifold.count; ++k) {
    const PilePoint& point = manifold.points[at(k)];
    const Vec3 relative = speed(a, point.world) - speed(b, point.world + a.position - b.position);
    const double approach = -manifold.frameOf(k).normal.dot(relative) - std::max(0.0, point.gap) / h_;
    const double tolerated = manifold.carries ? kBounceFrom : kFeasible * (heavy + light) / heavy;
    if (approach > tolerated * gravityMagnitude_ * h_) {
      return true;
    }
  }
  return false;
}

// [m/s] Slower approach is what forces give in a step, or rounding: no impact.
double Crowd::slowestBounce(const PileManifold& manifold) const {
  double strongest = acceleration(at(manifold.a)).norm();
  if (!manifold.b.isWall()) {
    strongest = std::max(strongest, acceleration(at(manifold.b.body())).norm());
  }
  return std::max(kBounceFrom * strongest * h_, kRounding * speed_);
}

// Where a point strikes within the step, those of its manifold that are almost closed strike with it.
void Crowd::addRows(int slot) {
  PileManifold& manifold = manifolds_[at(slot)];
  const bool hasWall = manifold.b.isWall();
  const PileBody& a = bodies_[at(manifold.a)];
  const int indexB = solver_.indexOf(manifold.b);
  const Vec3 apart = hasWall ? Vec3::Zero() : Vec3(a.position - bodyAt(manifold.b).position);
  const Vec3 vA = solver_.velocity(manifold.a);
  const Vec3 vB = solver_.velocity(indexB);
  std::array<double, PileManifold::kMost> speeds{};
  const double slow = slowestBounce(manifold);
  bool meets = false;
  for (int k = 0; k < manifold.count; ++k) {
    const PilePoint& point = manifold.points[at(k)];
    const Vec3 relative = vA + solver_.omega(manifold.a).cross(point.world) - vB -
                          solver_.omega(indexB).cross(point.world + apart);
    speeds[at(k)] = manifold.frameOf(k).normal.dot(relative);
    meets = meets || (point.gap + speeds[at(k)] * h_ <= 0 && -speeds[at(k)] > slow);
  }
  if (!hasWall && !a.still() && !bodyAt(manifold.b).still()) {
    const double ratio = a.inverseMass / bodyAt(manifold.b).inverseMass;
    heaviest_ = std::max({heaviest_, ratio, 1 / ratio});
  }
  const double together = kTogether * tolerance_;
  const PileFrame* begun = nullptr;
  for (int k = 0; k < manifold.count; ++k) {
    PilePoint& point = manifold.points[at(k)];
    const PileFrame& frame = manifold.frameOf(k);
    const double speed = speeds[at(k)];
    point.row = -1;
    point.curved = 0;
    if (point.gap + std::min(0.0, speed) * h_ > kAllowance * manifold.length) {
      point.normalImpulse = point.normalImpulseBefore = 0;
      continue;
    }
    if (begun != &frame) {
      solver_.beginBlock(manifold.a, manifold.b, manifold.friction, frame, apart);
      begun = &frame;
    }
    PileSolver::Row row{.arm = point.world};
    row.bound = meets && point.gap <= together ? 0 : -std::max(0.0, point.gap) / h_;
    row.normalImpulse = impulseScale_ * std::min(point.normalImpulse, kGrowth * point.normalImpulseBefore);
    if (row.normalImpulse > 0) {
      const double part = row.normalImpulse / point.normalImpulse;
      row.tangential1 = part * point.tangential1;
      row.tangential2 = part * point.tangential2;
    }
    point.row = static_cast<int>(solver_.rowCount());
    solver_.add(row);
    if (-speed > slow) {
      // Only the part of gravity before the time of contact counts, or bouncing would gain energy. The speed
      // is that of the middle.
      const double before = std::clamp(point.gap / (-speed * h_), 0.0, 1.0);
      const Vec3 fallA = a.still() ? Vec3(Vec3::Zero()) : acceleration(at(manifold.a));
      const Vec3 fallB =
          hasWall || bodyAt(manifold.b).still() ? Vec3(Vec3::Zero()) : acceleration(at(manifold.b.body()));
      const double fall = h_ * frame.normal.dot(fallA - fallB);
      const double approach = std::max(0.0, -(speed + (before - 0.5) * fall));
      bounces_.push_back({.row = point.row,
                          .speed = manifold.restitution * approach,
                          .approach = approach,
                          .fall = fall,
                          .slot = slot,
                          .point = k});
    }
  }
}

// The rows of the last step, at the gaps and with the impulses of now.
void Crowd::addPresentRows(const PileManifold& manifold) {
  const Vec3 apart = manifold.b.isWall()
                         ? Vec3(Vec3::Zero())
                         : Vec3(bodies_[at(manifold.a)].position - bodyAt(manifold.b).position);
  const PileFrame* begun = nullptr;
  for (int k = 0; k < manifold.count; ++k) {
    const PilePoint& point = manifold.points[at(k)];
    if (point.row < 0) {
      continue;
    }
    const PileFrame& frame = manifold.frameOf(k);
    if (begun != &frame) {
      solver_.beginBlock(manifold.a, manifold.b, manifold.friction, frame, apart);
      begun = &frame;
    }
    solver_.add({.arm = point.world,
                 .bound = -std::max(0.0, point.gap) / h_,
                 .normalImpulse = point.normalImpulse,
                 .tangential1 = point.tangential1,
                 .tangential2 = point.tangential2});
  }
}

void Crowd::keepImpulses() {
  for (const int slot : near_) {
    PileManifold& manifold = manifolds_[at(slot)];
    for (int k = 0; k < manifold.count; ++k) {
      PilePoint& point = manifold.points[at(k)];
      if (point.row >= 0) {
        point.normalImpulseBefore = point.normalImpulse;
        point.normalImpulse = solver_.normalImpulse(point.row);
        point.tangential1 = solver_.tangential1(point.row);
        point.tangential2 = solver_.tangential2(point.row);
      }
    }
  }
}

}  // namespace careen
