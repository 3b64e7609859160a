#include "physics/pile/crowd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace careen {
namespace {

constexpr std::int64_t kStepsPerSorting = 16;
// Lengths of steps, at the usual tolerance.
constexpr double kLongestStep = 1.0 / 180;   // [s]
constexpr double kShortestStep = 1.0 / 720;  // [s]
constexpr double kMostMoved =
    0x1p-4;  // [1] of the smallest size, motion per step: faster bodies take shorter steps
constexpr double kMostOfSpring = 0.25;  // [rad] phase of the stiffest spring per step
constexpr double kProjected = 3;        // longest steps between two projections
constexpr int kSweeps = 20;
constexpr std::int64_t kMostSweeps = 400;
constexpr std::int64_t kFewManifolds = 256;
constexpr int kPasses = 8;
constexpr double kLookAhead = 6;   // longest steps for which a fat AABB should stay valid
constexpr double kTell = 0x1p-14;  // [1] of the smallest size, change per step that re-solves neighbours
constexpr double kTellLeast = 0x1p-36;
constexpr std::int64_t kEasy = 4;
constexpr std::int64_t kHard = 8;
constexpr double kGrowth = 1.5;  // [1] largest growth of an impulse per step that the warm start accepts
constexpr int kMostHalvings = 6;
constexpr double kDeep = 1.5;  // [1] of the tolerance: penetration for which a step is halved
constexpr double kMostScaled = 4;
constexpr double kBounceFrom = 4;      // [1] of gravity × step: slower impacts do not bounce
constexpr double kAllowance = 0x1p-6;  // [1] of the smallest size: gaps that may close during a step
constexpr double kTogether = 3;        // [1] of the tolerance: points of one manifold that meet together
constexpr double kKink = 0.25;         // [1] of the tolerance: what smoothing a change of velocity may bend

}  // namespace

Crowd::Crowd(const World& world, double tolerance)
    : world_(world),
      tolerance_(tolerance),
      scale_(std::sqrt(tolerance / kUsualTolerance)),
      gravityMagnitude_(world.gravity.norm()),
      springLimit_(std::numeric_limits<double>::infinity()),
      h_(kLongestStep * scale_),
      pairs_(world.walls),
      projection_(tolerance),
      tell_(kTell) {
  if (!world.springs.empty() || world.drag) {
    for (const Body& body : world.bodies) {
      worldStates_.push_back(body.initial);
    }
  }
}

// ---- Members.

std::size_t Crowd::admit(std::size_t body, const BodyState& state, const Quat& attitude) {
  PileBody added = pileBody(world_.bodies[body], state);
  added.attitude = attitude;
  atRest_ = atRest_ && added.held;
  return place(added, body);
}

std::size_t Crowd::admitAtRest(std::size_t body, const Pose& pose, std::optional<std::size_t> cluster) {
  PileBody added = pileBody(world_.bodies[body], {.pose = pose});
  added.asleep = !added.held;
  const std::size_t index = place(added, body);
  bodies_[index].cluster = static_cast<int>(cluster.value_or(index));
  return index;
}

std::size_t Crowd::place(const PileBody& body, std::size_t listed) {
  if (free_.empty()) {
    free_.push_back(static_cast<int>(bodies_.size()));
    bodies_.emplace_back();
    listed_.emplace_back();
    before_.emplace_back();
    untouchedSteps_.emplace_back();
    unrest_.emplace_back();
    pairs_.addPlace();
  }
  const std::size_t index = at(free_.back());
  free_.pop_back();
  bodies_[index] = body;
  listed_[index] = listed;
  untouchedSteps_[index] = 0;
  unrest_[index] = std::numeric_limits<double>::max();
  limitBySprings(listed);
  return index;
}

void Crowd::dismiss(std::size_t place) {
  pairs_.clearPlace(static_cast<int>(place));
  bodies_[place] = {};
  bodies_[place].absent = true;
  free_.push_back(static_cast<int>(place));
}

// [s] Springs are integrated explicitly: stable, and accurate to about the tolerance, for a small phase.
void Crowd::limitBySprings(std::size_t listed) {
  for (const Spring& spring : world_.springs) {
    double mobility = 0;  // [1/kg]
    bool attached = false;
    for (const SpringEnd* end : {&spring.from, &spring.to}) {
      if (end->body) {
        const Body& body = world_.bodies[at(*end->body)];
        mobility +=
            body.mass.inverseMass + body.mass.inverseInertiaBody.maxCoeff() * end->point.squaredNorm();
        attached = attached || at(*end->body) == listed;
      }
    }
    if (attached && mobility > 0) {
      const double stiff = std::sqrt(spring.stiffness * mobility) + spring.damping * mobility;
      springLimit_ = stiff > 0 ? std::min(springLimit_, kMostOfSpring / stiff) : springLimit_;
    }
  }
}

// ---- A step: the whole method, up to freeze().

double Crowd::step(double most) {
  ++figures_.steps;
  if (figures_.steps % kStepsPerSorting == 0) {
    sortManifolds();
  }
  start_ = bodies_;
  take(chooseLength(most));
  for (int halving = 0; halving < kMostHalvings && wentDeep(); ++halving) {
    stepAgain(0.5 * h_);
  }
  return h_;
}

// Whether fast bodies went into each other in this step, by all 15 axes: the features of the manifolds of its
// start were not all that met.
bool Crowd::wentDeep() const {
  return std::any_of(near_.begin(), near_.end(), [&](int slot) {
    const PileManifold& manifold = manifolds_[at(slot)];
    const PileBody& a = bodies_[at(manifold.a)];
    if (manifold.b.isWall()) {
      return false;
    }
    const PileBody& b = bodyAt(manifold.b);
    if (relativeMotion(a, b, h_) < tolerance_) {
      return false;
    }
    const double depth = overlapOf(a, b);
    return depth > kDeep * tolerance_ &&
           depth > overlapOf(start_[at(manifold.a)], start_[at(manifold.b.body())]) + 0.5 * tolerance_;
  });
}

void Crowd::stepAgain(double length) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const bool woken = start_[i].asleep && !bodies_[i].asleep;
    const double path = bodies_[i].path;
    bodies_[i] = start_[i];
    bodies_[i].path = path;
    if (woken) {
      bodies_[i].asleep = false;
      bodies_[i].cluster = -1;
    }
  }
  for (const int slot : near_) {
    manifolds_[at(slot)].moved = std::numeric_limits<double>::max();  // they were those of other places
  }
  atRest_ = false;
  if (length > 0) {
    take(length);
  } else {
    impacts_.clear();
    for (Before& before : before_) {
      before.moved = false;
    }
  }
}

// Stores manifolds in processing order, for cache locality with thousands of boxes. The storage order does
// not affect results.
void Crowd::sortManifolds() {
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

// [s] What the fastest body requires, relative to its size.
double Crowd::chooseLength(double most) const {
  const double longest = kLongestStep * scale_;
  double fastest = 0;
  for (const PileBody& body : bodies_) {
    if (!body.still()) {
      fastest = std::max(fastest, (body.velocity.norm() + longest * gravityMagnitude_) / body.length);
    }
  }
  double h = longest;
  if (fastest > 0) {
    h = std::clamp(kMostMoved * scale_ / fastest, kShortestStep * scale_, longest);
  }
  return std::min({h, springLimit_, most});
}

// Whether a gap of the start of this step should not wait for the next projection.
bool Crowd::isDeep() const {
  return std::any_of(near_.begin(), near_.end(), [&](int slot) {
    const PileManifold& manifold = manifolds_[at(slot)];
    return std::any_of(manifold.points.begin(), manifold.points.begin() + manifold.count,
                       [&](const PilePoint& point) { return point.gap < -tolerance_; });
  });
}

double Crowd::fastest() const {
  double fastest = 0;
  for (const PileBody& body : bodies_) {
    fastest = body.still() ? fastest : std::max(fastest, body.velocity.norm());
  }
  return fastest;
}

Crowd::Extent Crowd::extent(double length) const {
  Extent extent{.low = Vec3::Constant(std::numeric_limits<double>::max()),
                .high = Vec3::Constant(-std::numeric_limits<double>::max())};
  for (const PileBody& body : bodies_) {
    if (!body.absent && !body.held) {
      const double way = body.asleep ? 0 : length * (body.velocity.norm() + length * gravityMagnitude_);
      extent.low = extent.low.cwiseMin(body.position - Vec3::Constant(body.radius + way));
      extent.high = extent.high.cwiseMax(body.position + Vec3::Constant(body.radius + way));
    }
  }
  return extent;
}

void Crowd::take(double length) {
  // Stored impulses are those of the last step. If that was much shorter, they are those of impacts.
  impulseScale_ = std::min(length / h_, kMostScaled);
  h_ = length;
  findLoads();
  lookAround();
  loadSolver();
  solver_.link();
  solver_.wakeAll();
  solve(kSweeps);
  keepImpulses();
  move();
  bounce();
  noteImpacts();
  countUntouched();
  sinceProjection_ += length;
  const bool due = sinceProjection_ >= kProjected * kLongestStep * scale_;
  if (due || isDeep()) {
    project();
  }
  if (due) {
    sinceProjection_ = 0;
    atRest_ = freeze();
  }
}

// Forces of springs and drag at the start of the step.
void Crowd::findLoads() {
  if (worldStates_.empty()) {
    return;
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].absent) {
      worldStates_[listed_[i]] = stateOf(bodies_[i]);
    }
  }
  computeLoads(world_, worldStates_, loads_);
}

// [m/s²] Without contacts.
Vec3 Crowd::acceleration(std::size_t place) const {
  return loads_.empty() ? world_.gravity : Vec3(bodies_[place].inverseMass * loads_[listed_[place]].force);
}

// The change threshold that re-solves neighbours adapts to the effort of the last step: coarse during heavy
// impacts, finer as the crowd comes to rest. Few manifolds are allowed more sweeps.
void Crowd::solve(int sweeps) {
  if (solveDirectly()) {
    return;
  }
  const auto manifolds = static_cast<std::int64_t>(solver_.blockCount()) + 1;
  const std::int64_t effort = 1 + kFewManifolds / manifolds;
  const std::int64_t solves = solver_.solve(static_cast<int>(std::min(sweeps * effort, kMostSweeps)), true);
  figures_.solves += solves;
  if (solves < kEasy * effort * manifolds) {
    tell_ = std::max(tell_ * 0.5, kTellLeast);
  } else if (solves > kHard * effort * manifolds) {
    tell_ = std::min(tell_ * 2, kTell);
  }
}

// Broad and narrow phase: pairs, and manifolds of the near ones. A contact that would push a sleeping body
// wakes its cluster, whose pairs are then tested too.
void Crowd::lookAround() {
  for (PileBody& body : bodies_) {
    body.ahead = body.still()
                     ? 0
                     : h_ * (body.velocity.norm() + body.radius * body.omega.norm() + h_ * gravityMagnitude_);
  }
  pairs_.update(bodies_, world_.gravity, h_, std::max(h_, kLookAhead * kLongestStep * scale_));
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
bool Crowd::lookAt(PilePair& pair) {
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

PileManifold& Crowd::manifoldOf(PilePair& pair) {
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
    if (approach * heavy > kFeasible * gravityMagnitude_ * h_ * (heavy + light)) {
      return true;
    }
  }
  return false;
}

void Crowd::wakeCluster(int cluster) {
  for (PileBody& body : bodies_) {
    if (body.asleep && body.cluster == cluster) {
      body.asleep = false;
      body.cluster = -1;
      ++figures_.woken;
    }
  }
}

void Crowd::loadSolver() {
  solver_.begin(bodies_.size());
  bounces_.clear();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const PileBody& body = bodies_[i];
    const int index = static_cast<int>(i);
    solver_.setBody(index, body, tell_ * body.length / h_);
    if (!body.still()) {
      solver_.velocity(index) = body.velocity + h_ * acceleration(i);
      solver_.omega(index) = body.omega;
      if (!loads_.empty()) {
        const Vec3 turned = body.axes.transpose() * loads_[listed_[i]].torque;
        solver_.omega(index) += h_ * (body.axes * body.inverseInertiaBody.cwiseProduct(turned));
      }
    }
  }
  for (const int slot : near_) {
    addRows(slot);
  }
  impulseScale_ = 1;
  figures_.rows += static_cast<std::int64_t>(solver_.rowCount());
  solver_.warmStart();
}

// Where a point meets within the step, those of its manifold that are almost closed meet with it.
void Crowd::addRows(int slot) {
  PileManifold& manifold = manifolds_[at(slot)];
  const bool hasWall = manifold.b.isWall();
  const PileBody& a = bodies_[at(manifold.a)];
  const int indexB = solver_.indexOf(manifold.b);
  const Vec3 apart = hasWall ? Vec3::Zero() : Vec3(a.position - bodyAt(manifold.b).position);
  const Vec3 vA = solver_.velocity(manifold.a);
  const Vec3 vB = solver_.velocity(indexB);
  std::array<double, PileManifold::kMost> speeds{};
  bool meets = false;
  for (int k = 0; k < manifold.count; ++k) {
    const PilePoint& point = manifold.points[at(k)];
    const Vec3 relative = vA + solver_.omega(manifold.a).cross(point.world) - vB -
                          solver_.omega(indexB).cross(point.world + apart);
    speeds[at(k)] = manifold.frameOf(k).normal.dot(relative);
    meets = meets || point.gap + speeds[at(k)] * h_ <= 0;
  }
  const double together = kTogether * tolerance_;
  bool begun = false;
  for (int k = 0; k < manifold.count; ++k) {
    PilePoint& point = manifold.points[at(k)];
    const PileFrame& frame = manifold.frameOf(k);
    const double speed = speeds[at(k)];
    point.row = -1;
    if (point.gap + std::min(0.0, speed) * h_ > kAllowance * manifold.length) {
      point.normalImpulse = point.normalImpulseBefore = 0;
      continue;
    }
    if (!begun) {
      solver_.beginManifold(manifold.a, manifold.b, manifold.friction);
      begun = true;
    }
    PileSolver::Row row{.armA = point.world, .armB = point.world + apart, .frame = frame};
    row.bound = meets && point.gap <= together ? 0 : -std::max(0.0, point.gap) / h_;
    row.normalImpulse = impulseScale_ * std::min(point.normalImpulse, kGrowth * point.normalImpulseBefore);
    if (row.normalImpulse > 0) {
      const double part = row.normalImpulse / point.normalImpulse;
      row.tangential1 = part * point.tangential1;
      row.tangential2 = part * point.tangential2;
    }
    point.row = static_cast<int>(solver_.rowCount());
    solver_.add(row);
    if (-speed > kBounceFrom * gravityMagnitude_ * h_) {
      // Only the part of gravity before the time of contact counts, or bouncing would gain energy.
      const double before = std::clamp(point.gap / (-speed * h_), 0.0, 1.0);
      const Vec3 fallA = a.still() ? Vec3(Vec3::Zero()) : acceleration(at(manifold.a));
      const Vec3 fallB =
          hasWall || bodyAt(manifold.b).still() ? Vec3(Vec3::Zero()) : acceleration(at(manifold.b.body()));
      const double fall = h_ * frame.normal.dot(fallA - fallB);
      const double approach = std::max(0.0, -(speed - (1 - before) * fall));
      bounces_.push_back({.row = point.row,
                          .speed = manifold.restitution * approach,
                          .approach = approach,
                          .slot = slot,
                          .point = k});
    }
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

// Bodies without contact impulse follow their parabola, the others the velocity after the solve.
void Crowd::move() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    PileBody& body = bodies_[i];
    before_[i].moved = false;
    if (body.still()) {
      continue;
    }
    const int index = static_cast<int>(i);
    Before& before = before_[i];
    before = {.position = body.position,
              .attitude = body.attitude,
              .velocity = body.velocity,
              .omega = body.omega,
              .angularMomentum = body.angularMomentum,
              .pushed = solver_.pushed(index),
              .moved = true};
    body.path += body.ahead;
    if (!before.pushed) {
      body.position += h_ * (body.velocity + 0.5 * h_ * acceleration(i));
      unrest_[i] = std::numeric_limits<double>::max();
    } else {
      body.position += h_ * solver_.velocity(index);
      unrest_[i] = (solver_.velocity(index) - body.velocity).norm() +
                   body.radius * (solver_.omega(index) - body.omega).norm();
      body.path += h_ * unrest_[i];
    }
    if (before.pushed || !loads_.empty()) {
      takeVelocity(body, index);
    } else {
      body.velocity = solver_.velocity(index);
    }
    turnFree(body, h_);
    before.endVelocity = body.velocity;
    before.endOmega = body.omega;
  }
}

// Impulses change L at the attitude at which they were solved.
void Crowd::takeVelocity(PileBody& body, int index) {
  const Vec3 change = body.axes.transpose() * (solver_.omega(index) - body.omega);
  body.angularMomentum += body.axes * body.inertiaBody.cwiseProduct(change);
  body.velocity = solver_.velocity(index);
}

// A member is untouched while no contact point is near it.
void Crowd::countUntouched() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    untouchedSteps_[i] = bodies_[i].still() ? 0 : untouchedSteps_[i] + 1;
  }
  for (const int slot : near_) {
    const PileManifold& manifold = manifolds_[at(slot)];
    untouchedSteps_[at(manifold.a)] = 0;
    if (!manifold.b.isWall()) {
      untouchedSteps_[at(manifold.b.body())] = 0;
    }
  }
}

// ---- Motion within the step.

// The change of velocity is spread over the step, unless that bends the path by more than a part of the
// tolerance: the cubic through both ends with both velocities differs from the straight line by 4/27 of it.
bool Crowd::isSmooth(std::size_t place) const {
  const Before& from = before_[place];
  const double change =
      (from.endVelocity - from.velocity).norm() + bodies_[place].radius * (from.endOmega - from.omega).norm();
  return !from.pushed || h_ * change * (4.0 / 27) <= kKink * tolerance_;
}

// [rad/s] Body frame: of the turn from one end to the other, to third order in the angle.
Vec3 Crowd::meanSpin(std::size_t place) const {
  const Quat turn = before_[place].attitude.conjugate() * bodies_[place].attitude;
  return (turn.w() < 0 ? -2 : 2) / h_ * turn.vec();
}

StepEnd Crowd::begin(std::size_t place) const {
  const Before& from = before_[place];
  StepEnd end{.position = from.position, .worldFromBody = from.attitude};
  if (isSmooth(place)) {
    end.velocity = from.velocity;
    end.spinBody = from.attitude.conjugate() * from.omega;
  } else {
    end.velocity = (bodies_[place].position - from.position) / h_;
    end.spinBody = meanSpin(place);
  }
  return end;
}

StepEnd Crowd::end(std::size_t place) const {
  const Before& from = before_[place];
  const PileBody& to = bodies_[place];
  StepEnd end{.position = to.position, .worldFromBody = to.attitude};
  if (isSmooth(place)) {
    end.velocity = from.endVelocity;
    end.spinBody = to.attitude.conjugate() * from.endOmega;
  } else {
    end.velocity = (to.position - from.position) / h_;
    end.spinBody = meanSpin(place);
  }
  return end;
}

void Crowd::project() {
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
  for (const int slot : near_) {
    const PileManifold& manifold = manifolds_[at(slot)];
    for (int k = 0; k < manifold.count; ++k) {
      deepest_ = std::max(deepest_, -manifold.points[at(k)].gap);
    }
  }
}

}  // namespace careen
