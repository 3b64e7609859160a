// Contacts of a crowd: broad and narrow phase, rows of the solver.
#include <algorithm>
#include <array>
#include <cmath>

#include "physics/pile/crowd.h"

namespace careen {
namespace {

constexpr double kLookAhead = 6;  // longest steps for which a fat AABB should stay valid
constexpr double kGrowth = 1.5;   // [1] largest growth of an impulse per step that the warm start accepts
// [1] Times as much, to a longer step: impulses of a much shorter one are those of impacts.
constexpr double kMostScaled = 4;
constexpr double kBounceFrom = 4;      // [1] of gravity × step: slower impacts do not bounce
constexpr double kRounding = 0x1p-30;  // [1] of the fastest speed: slower impacts do not either
// Gaps that may close during a step: that part of the smallest size, at the most; so many tolerances and what
// that part of the speeds of both bodies, and of those near them, closes.
constexpr double kAllowance = 0.1;
constexpr double kAllowedDepth = 4;
constexpr double kAllowedSpeed = 0.5;
constexpr double kTogether = 3;  // [1] of the tolerance: points of one manifold that meet together
constexpr double kUnseen = 2;    // [1] of the tolerance: motion after which other features may be deep

}  // namespace

// Broad and narrow phase: pairs, and manifolds of the near ones. A contact that would push a sleeping body
// wakes its cluster, whose pairs are then tested too.
void Crowd::lookAround() {
  paths_.resize(bodies_.size());
  forPlaces([&](std::size_t i) {
    PileBody& body = bodies_[i];
    body.turning = body.still() ? 0 : h_ * body.radius * body.omega.norm();
    body.ahead = body.still()
                     ? 0
                     : h_ * (body.velocity.norm() + (h_ + body.behind) * gravityMagnitude_) + body.turning;
    // One that sleeps may wake before its pairs are looked at.
    const double fall = h_ * (h_ + body.behind) * gravityMagnitude_;
    paths_[i] = body.path + (body.asleep ? fall : body.ahead);
  });
  pairs_.update(bodies_, world_.gravity, h_, std::max(h_, kLookAhead * longestStep()));
  unused_.insert(unused_.end(), pairs_.freed().begin(), pairs_.freed().end());
  pairs_.freed().clear();
  const std::vector<PilePair>& pairs = pairs_.pairs();
  looked_.assign(pairs.size(), Looked::kNot);
  besideSleep_.clear();
  for (bool woke = true; woke;) {
    lookAtAll();
    woke = false;
    for (const std::size_t k : besideSleep_) {
      const PilePair& pair = pairs[k];
      const PileBody& a = bodies_[at(pair.a)];
      if ((a.asleep || isAsleep(pair.b)) && wouldPush(pair, manifolds_[at(pair.slot)])) {
        wakeCluster(a.asleep ? a.cluster : bodyAt(pair.b).cluster);
        woke = true;
      }
    }
    if (woke) {
      wakeNeighbours();
    }
  }
  std::sort(besideSleep_.begin(), besideSleep_.end());
  near_.clear();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (looked_[k] == Looked::kNear) {
      near_.push_back(pairs[k].slot);
    }
  }
  std::fill(woken_.begin(), woken_.end(), 0);
  figures_.manifolds += static_cast<std::int64_t>(near_.size());
}

// At pairs of which one moves, but for those that were looked at in this step.
void Crowd::lookAtAll() {
  std::vector<PilePair>& pairs = pairs_.pairs();
  const std::size_t parts = at(team_->ranges(pairs.size()));
  looking_.resize(parts);
  team_->run(team_->ranges(pairs.size()), [&](int part) {
    Looking& looking = looking_[at(part)];
    looking.begun.clear();
    looking.left.clear();
    looking.besideSleep.clear();
    looking.pairs = looking.rebuilt = 0;
    const std::size_t last = pairs.size() * (at(part) + 1) / parts;
    for (std::size_t k = pairs.size() * at(part) / parts; k < last; ++k) {
      PilePair& pair = pairs[k];
      if (isClear(pair)) {
        ++looking.pairs;
        continue;
      }
      const bool still = bodies_[at(pair.a)].still() && (pair.b.isWall() || bodyAt(pair.b).still());
      if (looked_[k] != Looked::kNot || still) {
        continue;
      }
      ++looking.pairs;
      const bool isNew = pair.slot < 0;
      PileManifold& manifold = isNew ? looking.tried : manifolds_[at(pair.slot)];
      looked_[k] = lookAt(pair, manifold, looking.rebuilt);
      if (looked_[k] == Looked::kFar && !isNew) {
        looking.left.push_back(k);
      } else if (looked_[k] != Looked::kFar && isNew) {
        looking.begun.emplace_back(k, manifold);
      }
      if (looked_[k] == Looked::kNear &&
          (bodies_[at(pair.a)].asleep || isAsleep(pair.b) || manifold.carries)) {
        looking.besideSleep.push_back(k);
      }
    }
  });
  for (const Looking& looking : looking_) {
    figures_.pairs += looking.pairs;
    figures_.rebuilt += looking.rebuilt;
    besideSleep_.insert(besideSleep_.end(), looking.besideSleep.begin(), looking.besideSleep.end());
    for (const std::size_t k : looking.left) {
      unused_.push_back(std::exchange(pairs[k].slot, -1));
    }
    for (const auto& [k, manifold] : looking.begun) {
      keepManifold(pairs[k], manifold);
    }
  }
}

// Whether the two have not moved enough, along the paths up to paths_, to have contact points: the first
// look.
bool Crowd::isClear(const PilePair& pair) const {
  const double path = paths_[at(pair.a)] + (pair.b.isWall() ? 0 : paths_[at(pair.b.body())]);
  return pair.slot < 0 && path < pair.until;
}

// [m] By how much the two may still come nearer than when they were last looked at, at the least, before
// there can be contact points.
double Crowd::wayLeft(const PilePair& pair) const {
  const PileBody& a = bodies_[at(pair.a)];
  if (pair.b.isWall()) {
    return pair.clear - std::abs(dot(wallAt(pair.b).normal, a.position - pair.apart)) -
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

// `manifold` is the pair's, or, if it has none, one to try.
Crowd::Looked Crowd::lookAt(PilePair& pair, PileManifold& manifold, std::int64_t& rebuilt) const {
  const PileBody& a = bodies_[at(pair.a)];
  const bool hasWall = pair.b.isWall();
  if (pair.slot < 0) {
    const double left = pair.clear > 0 ? wayLeft(pair) : 0;
    if (wayAhead(pair) < left) {
      pair.until = a.path + (hasWall ? 0 : bodyAt(pair.b).path) + left;
      return Looked::kFar;
    }
    beginManifold(pair, manifold);
  }
  const double motion = hasWall ? a.ahead : relativeMotion(a, bodyAt(pair.b), h_);
  manifold.moved += motion;
  const double length = manifold.length;
  bool touching = manifold.count > 0;
  if (!touching || manifold.moved > rebuildAfter(length) ||
      manifold.moved + motion + 0.5 * PileLengths::kReach * length > manifold.reach) {
    ++rebuilt;
    manifold.reach = PileLengths::kReach * length + 1.5 * motion;
    touching = hasWall ? buildManifold(a, wallAt(pair.b), manifold.reach, manifold)
                       : buildManifold(a, bodyAt(pair.b), manifold.reach, manifold);
  } else if (hasWall) {
    refreshManifold(a, wallAt(pair.b), manifold);
  } else {
    refreshManifold(a, bodyAt(pair.b), manifold);
  }
  if (touching) {
    return manifold.count > 0 ? Looked::kNear : Looked::kBare;
  }
  const PileBody* b = hasWall ? nullptr : &bodyAt(pair.b);
  pair.apart = b == nullptr ? a.position : Vec3(a.position - b->position);
  pair.turned = a.turned + (b == nullptr ? 0 : b->turned);
  pair.clear = manifold.separation - PileLengths::kReach * length;
  pair.until = a.path + (b == nullptr ? 0 : b->path) + pair.clear;
  return Looked::kFar;
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
  manifold.span = span_;
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
    const double approach = -dot(manifold.frameOf(k).normal, relative) - std::max(0.0, point.gap) / h_;
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

// What a body may be struck with in the step: those that strike it are near it.
void Crowd::findPushing() {
  std::vector<double> own(bodies_.size());
  forPlaces([&](std::size_t i) {
    const int index = static_cast<int>(i);
    own[i] = solver_.velocity(index).norm() + bodies_[i].radius * solver_.omega(index).norm();
  });
  pushing_ = own;
  forNear([&](const PileManifold& manifold, std::size_t) {
    if (!manifold.b.isWall()) {
      const std::size_t a = at(manifold.a);
      const std::size_t b = at(manifold.b.body());
      raiseTo(pushing_[a], own[b]);
      raiseTo(pushing_[b], own[a]);
    }
  });
}

// What is to be known of a manifold before its rows are added, and how many there will be. Where a point
// strikes within the step, those of its manifold that are almost closed strike with it.
PileSolver::Extent Crowd::lookForRows(PileManifold& manifold) const {
  const bool hasWall = manifold.b.isWall();
  const int indexB = solver_.indexOf(manifold.b);
  const Vec3 apart =
      hasWall ? Vec3::Zero() : Vec3(bodies_[at(manifold.a)].position - bodyAt(manifold.b).position);
  const Vec3 vA = solver_.velocity(manifold.a);
  const Vec3 vB = solver_.velocity(indexB);
  const double slow = slowestBounce(manifold);
  const double pushing = pushing_[at(manifold.a)] + (hasWall ? 0 : pushing_[at(manifold.b.body())]);
  const double mayClose =
      std::min(kAllowance * manifold.length, kAllowedDepth * tolerance_ + kAllowedSpeed * h_ * pushing);
  PileSolver::Extent rows;
  const ContactFrame* begun = nullptr;
  manifold.meets = manifold.strikes = false;
  for (int k = 0; k < manifold.count; ++k) {
    PilePoint& point = manifold.points[at(k)];
    const Vec3 relative = vA + solver_.omega(manifold.a).cross(point.world) - vB -
                          solver_.omega(indexB).cross(point.world + apart);
    point.speed = dot(manifold.frameOf(k).normal, relative);
    point.curved = 0;
    point.strikes = -point.speed > slow;
    point.row = point.gap + std::min(0.0, point.speed) * h_ > mayClose ? -1 : 0;
    manifold.meets = manifold.meets || (point.gap + point.speed * h_ <= 0 && point.strikes);
    if (point.row < 0) {
      point.normalImpulse = point.normalImpulseBefore = 0;
      continue;
    }
    manifold.strikes = manifold.strikes || point.strikes;
    rows.blocks += begun == &manifold.frameOf(k) ? 0 : 1;
    begun = &manifold.frameOf(k);
    ++rows.rows;
  }
  return rows;
}

void Crowd::addRows(PileManifold& manifold, PileSolver::Extent next) {
  const Vec3 apart = manifold.b.isWall()
                         ? Vec3(Vec3::Zero())
                         : Vec3(bodies_[at(manifold.a)].position - bodyAt(manifold.b).position);
  const double together = kTogether * tolerance_;
  const double scale = std::min(span_ / manifold.span, kMostScaled);
  for (int k = 0; k < manifold.count;) {
    const ContactFrame& frame = manifold.frameOf(k);
    const int first = next.rows;
    for (; k < manifold.count && &manifold.frameOf(k) == &frame; ++k) {
      PilePoint& point = manifold.points[at(k)];
      if (point.row < 0) {
        continue;
      }
      PileSolver::Row row{.arm = point.world};
      row.bound = manifold.meets && point.gap <= together ? 0 : -std::max(0.0, point.gap) / h_;
      row.normalImpulse = scale * std::min(point.normalImpulse, kGrowth * point.normalImpulseBefore);
      if (row.normalImpulse > 0) {
        const double part = row.normalImpulse / point.normalImpulse;
        row.tangential1 = part * point.tangential1;
        row.tangential2 = part * point.tangential2;
      }
      point.row = next.rows++;
      solver_.setRow(point.row, row);
    }
    if (next.rows > first) {
      solver_.setBlock({.blocks = next.blocks++, .rows = first}, next.rows - first, manifold.a, manifold.b,
                       manifold.friction, frame, apart);
    }
  }
}

// Only the part of gravity before the time of contact counts, or bouncing would gain energy. Speeds are those
// of the middle.
void Crowd::addBounces(const PileManifold& manifold, int slot) {
  for (int k = 0; manifold.strikes && k < manifold.count; ++k) {
    const PilePoint& point = manifold.points[at(k)];
    if (point.row < 0 || !point.strikes) {
      continue;
    }
    const double before = std::clamp(point.gap / (-point.speed * h_), 0.0, 1.0);
    const auto falling = [&](int body) {
      return bodies_[at(body)].still() ? Vec3(Vec3::Zero()) : acceleration(at(body));
    };
    const Vec3 fallB = manifold.b.isWall() ? Vec3(Vec3::Zero()) : falling(manifold.b.body());
    const double fall = h_ * dot(manifold.frameOf(k).normal, falling(manifold.a) - fallB);
    const double approach = std::max(0.0, -(point.speed + (before - 0.5) * fall));
    bounces_.push_back({.row = point.row,
                        .speed = manifold.restitution * approach,
                        .approach = approach,
                        .fall = fall,
                        .slot = slot,
                        .point = k});
  }
}

// Those that have one, at the gaps and with the impulses of now.
void Crowd::addPresentRows(const PileManifold& manifold) {
  const Vec3 apart = manifold.b.isWall()
                         ? Vec3(Vec3::Zero())
                         : Vec3(bodies_[at(manifold.a)].position - bodyAt(manifold.b).position);
  const ContactFrame* begun = nullptr;
  for (int k = 0; k < manifold.count; ++k) {
    const PilePoint& point = manifold.points[at(k)];
    if (point.row < 0) {
      continue;
    }
    const ContactFrame& frame = manifold.frameOf(k);
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
  forNear([&](PileManifold& manifold, std::size_t) {
    manifold.span = span_;
    for (int k = 0; k < manifold.count; ++k) {
      PilePoint& point = manifold.points[at(k)];
      if (point.row >= 0) {
        point.normalImpulseBefore = point.normalImpulse;
        point.normalImpulse = solver_.normalImpulse(point.row);
        point.tangential1 = solver_.tangential1(point.row);
        point.tangential2 = solver_.tangential2(point.row);
      }
    }
  });
}

}  // namespace careen
