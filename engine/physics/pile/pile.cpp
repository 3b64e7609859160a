#include "physics/pile/pile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/names.h"

namespace careen {
namespace {

constexpr std::int64_t kFramesPerSorting = 4;
constexpr double kLeastSubsteps = 3;  // per frame
constexpr double kMostSubsteps = 12;
constexpr double kMostMovedInSubstep =
    0x1p-4;  // [1] of the smallest size, motion per substep: faster bodies need more substeps
constexpr std::int64_t kSweeps = 20;
constexpr std::int64_t kMostSweeps = 400;
constexpr std::int64_t kFewManifolds = 256;
constexpr int kPasses = 8;
constexpr double kLookAhead = 2;   // frames for which a fat AABB should stay valid
constexpr double kTell = 0x1p-14;  // [1] of the smallest size, change per substep that re-solves neighbours
constexpr double kTellLeast = 0x1p-36;
constexpr std::int64_t kEasy = 4;
constexpr std::int64_t kHard = 8;
constexpr double kGrowth = 1.5;    // [1] largest growth of an impulse per substep that the warm start accepts
constexpr double kBounceFrom = 4;  // [1] of gravity × substep: slower impacts do not bounce
constexpr double kAllowance = 0x1p-6;  // [1] of the smallest size: gaps that may close during a substep

}  // namespace

Pile::Pile(const World& world, std::vector<BodyState> states, double frame)
    : gravity_(world.gravity),
      gravityMagnitude_(world.gravity.norm()),
      walls_(world.walls),
      frame_(frame),
      h_(frame / kLeastSubsteps),
      rankOf_(world.bodies.size()),
      bodyOf_(orderByName(world.bodies)),
      states_(std::move(states)),
      pairs_({}, {}),
      tell_(kTell) {
  for (std::size_t rank = 0; rank < bodyOf_.size(); ++rank) {
    const std::size_t body = bodyOf_[rank];
    rankOf_[body] = rank;
    bodies_.push_back(pileBody(world.bodies[body], states_[body]));
  }
  pairs_ = PilePairs(bodies_, walls_);
  unrest_.assign(bodies_.size(), std::numeric_limits<double>::max());
}

// The whole method, up to freeze().

void Pile::step() {
  ++figures_.frames;
  if (atRest_) {
    return;
  }
  if (figures_.frames % kFramesPerSorting == 0) {
    sortManifolds();
  }
  const int substeps = chooseSubsteps();
  for (int k = 0; k < substeps; ++k) {
    substep(k == 0 ? frame_ : h_);
  }
  project();
  atRest_ = freeze();
  for (std::size_t rank = 0; rank < bodies_.size(); ++rank) {
    if (!bodies_[rank].held) {
      states_[bodyOf_[rank]] = stateOf(bodies_[rank]);
    }
  }
}

// Stores manifolds in processing order, for cache locality with thousands of boxes. The storage order does
// not affect results.
void Pile::sortManifolds() {
  std::vector<PileManifold> sorted;
  sorted.reserve(manifolds_.size());
  for (PilePair& pair : pairs_.pairs()) {
    if (pair.slot >= 0) {
      sorted.push_back(manifolds_[at(pair.slot)]);
      pair.slot = static_cast<int>(sorted.size()) - 1;
    }
  }
  manifolds_.swap(sorted);
  unused_.clear();
  near_.clear();
}

// As many as the fastest body requires, relative to its size. Stored impulses are those of the last substep
// and are scaled in proportion to the substep length.
int Pile::chooseSubsteps() {
  double fastest = 0;
  for (const PileBody& body : bodies_) {
    if (!body.still()) {
      fastest = std::max(fastest, (body.velocity.norm() + frame_ * gravityMagnitude_) / body.length);
    }
  }
  const int substeps =
      static_cast<int>(std::clamp(1 + fastest * frame_ / kMostMovedInSubstep, kLeastSubsteps, kMostSubsteps));
  const double h = frame_ / substeps;
  impulseScale_ = h / h_;
  h_ = h;
  return substeps;
}

void Pile::substep(double lookAhead) {
  ++figures_.substeps;
  lookAround(lookAhead);
  loadSolver();
  solver_.link();
  solver_.wakeAll();
  solve();
  keepImpulses();
  move();
  bounce();
}

// The change threshold that re-solves neighbours adapts to the effort of the last substep: coarse during
// heavy impacts, finer as the pile comes to rest. Few manifolds are allowed more sweeps.
void Pile::solve() {
  const auto manifolds = static_cast<std::int64_t>(solver_.blockCount()) + 1;
  const std::int64_t effort = 1 + kFewManifolds / manifolds;
  const std::int64_t solves = solver_.solve(static_cast<int>(std::min(kSweeps * effort, kMostSweeps)), true);
  figures_.solves += solves;
  if (solves < kEasy * effort * manifolds) {
    tell_ = std::max(tell_ * 0.5, kTellLeast);
  } else if (solves > kHard * effort * manifolds) {
    tell_ = std::min(tell_ * 2, kTell);
  }
}

// Broad and narrow phase: pairs, and manifolds of the near ones. A contact that would push a sleeping body
// wakes its cluster, whose pairs are then tested too.
void Pile::lookAround(double time) {
  for (PileBody& body : bodies_) {
    body.ahead = body.still()
                     ? 0
                     : h_ * (body.velocity.norm() + body.radius * body.omega.norm() + h_ * gravityMagnitude_);
  }
  pairs_.update(bodies_, gravity_, time, kLookAhead * frame_);
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
      if (looked_[k] == 2 && (a.asleep || (!pair.b.isWall() && bodyAt(pair.b).asleep)) &&
          wouldPush(pair, manifolds_[at(pair.slot)])) {
        wakeCluster(a.asleep ? a.cluster : bodyAt(pair.b).cluster);
        woke = true;
      }
    }
  }
  near_.clear();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (looked_[k] == 2) {
      near_.push_back(pairs[k].slot);
    }
  }
  figures_.manifolds += static_cast<std::int64_t>(near_.size());
}

// Whether the pair has a manifold with points.
bool Pile::lookAt(PilePair& pair) {
  ++figures_.pairs;
  const PileBody& a = bodies_[at(pair.a)];
  const bool hasWall = pair.b.isWall();
  const double pathB = hasWall ? 0 : bodyAt(pair.b).path;
  const double aheadB = hasWall ? 0 : bodyAt(pair.b).ahead;
  if (pair.slot < 0 && a.path + pathB + a.ahead + aheadB < pair.until) {
    return false;
  }
  PileManifold& manifold = manifoldOf(pair);
  const double motion = hasWall ? a.ahead : relativeMotion(a, bodyAt(pair.b), h_);
  manifold.moved += motion;
  const double length = manifold.length;
  bool touching = manifold.count > 0;
  if (!touching || manifold.moved > PileLengths::kRebuild * length ||
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
    pair.until = a.path + pathB + manifold.separation - PileLengths::kReach * length;
    unused_.push_back(pair.slot);
    pair.slot = -1;
    return false;
  }
  return manifold.count > 0;
}

PileManifold& Pile::manifoldOf(PilePair& pair) {
  if (pair.slot >= 0) {
    return manifolds_[at(pair.slot)];
  }
  if (unused_.empty()) {
    unused_.push_back(static_cast<int>(manifolds_.size()));
    manifolds_.emplace_back();
  }
  pair.slot = unused_.back();
  unused_.pop_back();
  PileManifold& manifold = manifolds_[at(pair.slot)];
  manifold = {};
  manifold.a = pair.a;
  manifold.b = pair.b;
  const PileBody& a = bodies_[at(pair.a)];
  const Material material =
      touching(a.material, pair.b.isWall() ? wallAt(pair.b).material : bodyAt(pair.b).material);
  manifold.friction = material.friction;
  manifold.restitution = material.restitution;
  manifold.length = pair.b.isWall() ? a.length : std::min(a.length, bodyAt(pair.b).length);
  return manifold;
}

// Whether the moving body would push the sleeping one by more than the tolerated imbalance at rest.
bool Pile::wouldPush(const PilePair& pair, const PileManifold& manifold) const {
  const PileBody& a = bodies_[at(pair.a)];
  const PileBody& b = bodyAt(pair.b);
  const auto speed = [&](const PileBody& body, const Vec3& arm) {
    return body.still() ? Vec3(Vec3::Zero()) : Vec3(body.velocity + h_ * gravity_ + body.omega.cross(arm));
  };
  const double heavy = a.asleep ? a.inverseMass : b.inverseMass;
  const double light = a.asleep ? b.inverseMass : a.inverseMass;
  for (int k = 0; k < manifold.count; ++k) {
    const PilePoint& point = manifold.points[at(k)];
    const Vec3 relative = speed(a, point.world) - speed(b, point.world + a.position - b.position);
    const double approach = -manifold.frameOf(k).normal.dot(relative) - std::max(0.0, point.gap) / h_;
    if (approach * heavy > kFeasible * gravityMagnitude_ * h_ * (heavy + light)) {
      return true;
    }
  }
  return false;
}

void Pile::wakeCluster(int cluster) {
  for (PileBody& body : bodies_) {
    if (body.asleep && body.cluster == cluster) {
      body.asleep = false;
      body.cluster = -1;
      ++figures_.woken;
    }
  }
}

void Pile::loadSolver() {
  solver_.begin(bodies_.size());
  bounces_.clear();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const PileBody& body = bodies_[i];
    const int index = static_cast<int>(i);
    solver_.setBody(index, body, tell_ * body.length / h_);
    if (!body.still()) {
      solver_.velocity(index) = body.velocity + h_ * gravity_;
      solver_.omega(index) = body.omega;
    }
  }
  for (const int slot : near_) {
    addRows(manifolds_[at(slot)]);
  }
  impulseScale_ = 1;
  figures_.rows += static_cast<std::int64_t>(solver_.rowCount());
  solver_.warmStart();
}

void Pile::addRows(PileManifold& manifold) {
  const bool hasWall = manifold.b.isWall();
  const PileBody& a = bodies_[at(manifold.a)];
  const int indexB = solver_.indexOf(manifold.b);
  const Vec3 apart = hasWall ? Vec3::Zero() : Vec3(a.position - bodyAt(manifold.b).position);
  const Vec3 vA = solver_.velocity(manifold.a);
  const Vec3 vB = solver_.velocity(indexB);
  bool begun = false;
  for (int k = 0; k < manifold.count; ++k) {
    PilePoint& point = manifold.points[at(k)];
    const PileFrame& frame = manifold.frameOf(k);
    const Vec3 armB = point.world + apart;
    const Vec3 relative =
        vA + solver_.omega(manifold.a).cross(point.world) - vB - solver_.omega(indexB).cross(armB);
    const double speed = frame.normal.dot(relative);
    point.row = -1;
    if (point.gap + std::min(0.0, speed) * h_ > kAllowance * manifold.length) {
      point.normalImpulse = point.normalImpulseBefore = 0;
      continue;
    }
    if (!begun) {
      solver_.beginManifold(manifold.a, manifold.b, manifold.friction);
      begun = true;
    }
    PileSolver::Row row{.armA = point.world, .armB = armB, .frame = frame};
    row.bound = -std::max(0.0, point.gap) / h_;
    row.normalImpulse = impulseScale_ * std::min(point.normalImpulse, kGrowth * point.normalImpulseBefore);
    if (row.normalImpulse > 0) {
      const double part = row.normalImpulse / point.normalImpulse;
      row.tangential1 = part * point.tangential1;
      row.tangential2 = part * point.tangential2;
    }
    point.row = static_cast<int>(solver_.rowCount());
    solver_.add(row);
    if (manifold.restitution > 0 && -speed > kBounceFrom * gravityMagnitude_ * h_) {
      // Only the part of gravity before the time of contact counts, or bouncing would gain energy.
      const double before = std::clamp(point.gap / (-speed * h_), 0.0, 1.0);
      const double held = (a.still() ? 0 : 1) - (hasWall || bodyAt(manifold.b).still() ? 0 : 1);
      const double fromGravity = held * h_ * frame.normal.dot(gravity_);
      const double impact = -(speed - (1 - before) * fromGravity);
      bounces_.push_back({.row = point.row, .speed = manifold.restitution * std::max(0.0, impact)});
    }
  }
}

void Pile::keepImpulses() {
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

// Bodies without contact impulse follow their parabola, the others the velocity after the solve.
void Pile::move() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    PileBody& body = bodies_[i];
    if (body.still()) {
      continue;
    }
    const int index = static_cast<int>(i);
    body.path += body.ahead;
    if (!solver_.pushed(index)) {
      body.position += h_ * (body.velocity + 0.5 * h_ * gravity_);
      body.velocity = solver_.velocity(index);
      unrest_[i] = std::numeric_limits<double>::max();
    } else {
      body.position += h_ * solver_.velocity(index);
      unrest_[i] = (solver_.velocity(index) - body.velocity).norm() +
                   body.radius * (solver_.omega(index) - body.omega).norm();
      body.path += h_ * unrest_[i];
      takeVelocity(body, index);
    }
    turnFree(body, h_);
  }
}

// Impulses change L at the attitude at which they were solved.
void Pile::takeVelocity(PileBody& body, int index) {
  const Vec3 change = body.axes.transpose() * (solver_.omega(index) - body.omega);
  body.angularMomentum += body.axes * body.inertiaBody.cwiseProduct(change);
  body.velocity = solver_.velocity(index);
}

// Manifolds do not yet include the relative motion of the last substep.
void Pile::project() {
  for (int pass = 0; pass < kPasses; ++pass) {
    for (const int slot : near_) {
      PileManifold& manifold = manifolds_[at(slot)];
      const PileBody& a = bodies_[at(manifold.a)];
      if (manifold.b.isWall()) {
        refreshManifold(a, wallAt(manifold.b), manifold);
        continue;
      }
      const PileBody& b = bodyAt(manifold.b);
      const double unseen = pass == 0 ? relativeMotion(a, b, h_) : 0;
      if (manifold.moved + unseen > PileLengths::kRebuild * manifold.length) {
        ++figures_.rebuilt;
        buildManifold(a, b, manifold.reach, manifold);
      } else {
        refreshManifold(a, b, manifold);
      }
    }
    if (!projection_.pass(bodies_, manifolds_, near_, 3 << std::min(pass, 4))) {
      break;
    }
    ++figures_.projections;
  }
}

}  // namespace careen
