// Sleeping, and how deep bodies are in each other.
#include <algorithm>
#include <cmath>

#include "physics/pile/crowd.h"

namespace careen {
namespace {

constexpr double kFrictionless = 0x1p-20;  // μ below which friction stops nothing
constexpr int kLayers = 3;  // contacts from a body that is not quiet within which all stay awake
constexpr int kChecks = 4;  // that a part of a cluster must pass before it sleeps

constexpr double kDeep = 1.5;  // [1] of the tolerance: new penetration that is projected at once

bool pushes(const PileManifold& manifold) {
  return std::any_of(manifold.points.begin(), manifold.points.begin() + manifold.count,
                     [](const PilePoint& point) { return point.normalImpulse > 0; });
}

}  // namespace

// A cluster in contact falls asleep if, with all velocities set to zero, gravity and the last impulses nearly
// balance on every body: then it would not move, and these impulses, which lie in their friction cones, hold
// it indefinitely. Motion at constant speed passes that test too, so the speed must also be one that friction
// can stop within the substep, μ g h.
bool Crowd::freeze() {
  grip_.assign(bodies_.size(), kFrictionless);
  clusters_.reset(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].asleep) {
      clusters_.join(i, at(bodies_[i].cluster));
    }
  }
  for (const int slot : near_) {
    const PileManifold& manifold = manifolds_[at(slot)];
    if (!pushes(manifold)) {
      continue;
    }
    grip_[at(manifold.a)] = std::max(grip_[at(manifold.a)], manifold.friction);
    if (!manifold.b.isWall()) {
      grip_[at(manifold.b.body())] = std::max(grip_[at(manifold.b.body())], manifold.friction);
      if (!bodies_[at(manifold.a)].held && !bodyAt(manifold.b).held) {
        clusters_.join(at(manifold.a), at(manifold.b.body()));
      }
    }
  }
  std::vector<char> quietBody;
  findQuiet(quietBody);
  std::vector<char> quiet(bodies_.size(), 1);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (quietBody[i] == 0) {
      quiet[clusters_.root(i)] = 0;
    }
  }
  bool all = true;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    PileBody& body = bodies_[i];
    const std::size_t root = clusters_.root(i);
    if (body.held || body.absent || (body.asleep && quiet[root] == 0)) {
      continue;
    }
    if (quiet[root] == 0) {
      all = false;
      continue;
    }
    body.cluster = static_cast<int>(root);
    if (!body.asleep) {
      body.asleep = true;
      body.velocity = body.angularMomentum = body.omega = Vec3::Zero();
      ++figures_.frozen;
    }
  }
  if (!all) {
    freezeParts(quietBody);
  }
  for (const int slot : near_) {
    PileManifold& manifold = manifolds_[at(slot)];
    const bool sleeps = bodies_[at(manifold.a)].asleep || isAsleep(manifold.b);
    if (sleeps && !manifold.carries) {
      manifold.carried = forceOf(manifold);
    }
    manifold.carries = sleeps;
  }
  return all;
}

void Crowd::findQuiet(std::vector<char>& quiet) {
  quiet.assign(bodies_.size(), 1);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const PileBody& body = bodies_[i];
    const double speed = body.velocity.norm() + body.radius * body.omega.norm();
    quiet[i] = body.still() || (unrest_[i] <= kFeasible * gravityMagnitude_ * h_ &&
                                speed <= grip_[i] * gravityMagnitude_ * h_)
                   ? 1
                   : 0;
  }
}

// One restless body keeps only those awake that are a few contacts from it. The others sleep under the load
// of the last ones awake, which are quiet, until it changes.
void Crowd::freezeParts(const std::vector<char>& quiet) {
  std::vector<int> layer(bodies_.size(), kLayers + 1);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (quiet[i] == 0) {
      layer[i] = 0;
    }
  }
  for (int next = 1; next <= kLayers; ++next) {
    for (const int slot : near_) {
      const PileManifold& manifold = manifolds_[at(slot)];
      if (!manifold.b.isWall()) {
        const std::size_t a = at(manifold.a);
        const std::size_t b = at(manifold.b.body());
        layer[b] = layer[a] == next - 1 ? std::min(layer[b], next) : layer[b];
        layer[a] = layer[b] == next - 1 ? std::min(layer[a], next) : layer[a];
      }
    }
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    PileBody& body = bodies_[i];
    quietChecks_[i] = body.still() || layer[i] <= kLayers ? 0 : quietChecks_[i] + 1;
    if (quietChecks_[i] >= kChecks) {
      quietChecks_[i] = 0;
      body.asleep = true;
      body.cluster = static_cast<int>(i);
      body.velocity = body.angularMomentum = body.omega = Vec3::Zero();
      ++figures_.frozen;
    }
  }
}

// Of two that can move, one sleeps.
bool Crowd::isHalfAsleep(const PileManifold& manifold) const {
  if (manifold.b.isWall() || bodies_[at(manifold.a)].held || bodyAt(manifold.b).held) {
    return false;
  }
  return bodies_[at(manifold.a)].asleep != bodyAt(manifold.b).asleep;
}

// [N] On a, in the last step.
Vec3 Crowd::forceOf(const PileManifold& manifold) const {
  Vec3 impulse = Vec3::Zero();
  for (int k = 0; k < manifold.count; ++k) {
    const PilePoint& point = manifold.points[at(k)];
    const PileFrame& frame = manifold.frameOf(k);
    impulse += point.normalImpulse * frame.normal + point.tangential1 * frame.tangent1 +
               point.tangential2 * frame.tangent2;
  }
  return impulse / h_;
}

void Crowd::findDisturbed() {
  disturbed_.clear();
  for (const int slot : near_) {
    PileManifold& manifold = manifolds_[at(slot)];
    if (!manifold.carries) {
      continue;
    }
    if (!isHalfAsleep(manifold)) {
      manifold.carries = false;
      continue;
    }
    const PileBody& sleeper = bodies_[at(manifold.a)].asleep ? bodies_[at(manifold.a)] : bodyAt(manifold.b);
    const double load = manifold.carried.norm() + gravityMagnitude_ / sleeper.inverseMass;
    if ((forceOf(manifold) - manifold.carried).norm() > kMayChange * load) {
      disturbed_.push_back(sleeper.cluster);
    }
  }
}

// At the start of the next step, as they did not move in this one.
void Crowd::wakeDisturbed() {
  if (disturbed_.empty()) {
    return;
  }
  for (const int cluster : disturbed_) {
    wakeCluster(cluster);
  }
  disturbed_.clear();
  wakeNeighbours();
}

void Crowd::wakeCluster(int cluster) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    PileBody& body = bodies_[i];
    if (body.asleep && body.cluster == cluster) {
      body.asleep = false;
      body.cluster = -1;
      woken_[i] = 1;
      quietChecks_[i] = 0;
      ++figures_.woken;
    }
  }
}

// Those a few contacts from one that was woken: where a part of a cluster slept, it wakes by parts.
void Crowd::wakeNeighbours() {
  std::vector<int> clusters;
  for (int layer = 0; layer < kLayers; ++layer) {
    clusters.clear();
    for (const PilePair& pair : pairs_.pairs()) {
      if (pair.slot < 0 || pair.b.isWall() || !isHalfAsleep(manifolds_[at(pair.slot)])) {
        continue;
      }
      const PileBody& a = bodies_[at(pair.a)];
      if (woken_[at(a.asleep ? pair.b.body() : pair.a)] != 0 && pushes(manifolds_[at(pair.slot)])) {
        clusters.push_back(a.asleep ? a.cluster : bodyAt(pair.b).cluster);
      }
    }
    for (const int cluster : clusters) {
      wakeCluster(cluster);
    }
  }
}

// [m] How deep fast bodies went into each other and into walls in this step, if more than kDeep: the features
// of the manifolds of its start were not all that met.
double Crowd::newDepth() {
  double deepest = 0;
  for (const PilePair& pair : pairs_.pairs()) {
    const double depth = depthSince(pair);
    deepest = std::max(deepest, depth);
    if (depth > 0 && pair.slot >= 0) {
      manifolds_[at(pair.slot)].moved = std::numeric_limits<double>::max();  // to be rebuilt
    }
  }
  return deepest;
}

double Crowd::depthSince(const PilePair& pair) const {
  const PileBody& a = bodies_[at(pair.a)];
  const PileBody* b = pair.b.isWall() ? nullptr : &bodyAt(pair.b);
  const bool apart = pair.slot < 0 && a.path + (b == nullptr ? 0 : b->path) < pair.until;
  if (apart || (b == nullptr ? a.path - start_[at(pair.a)].path : relativeMotion(a, *b, h_)) < tolerance_) {
    return 0;
  }
  const double depth = b == nullptr ? overlapOf(a, wallAt(pair.b)) : overlapOf(a, *b);
  if (depth <= kDeep * tolerance_) {
    return 0;
  }
  const PileBody& start = start_[at(pair.a)];
  const double before =
      b == nullptr ? overlapOf(start, wallAt(pair.b)) : overlapOf(start, start_[at(pair.b.body())]);
  return depth > before + 0.5 * tolerance_ ? depth : 0;
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
