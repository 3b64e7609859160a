// Sleeping.
#include <algorithm>
#include <cmath>

#include "physics/pile/crowd.h"

namespace careen {
namespace {

constexpr double kFrictionless = 0x1p-20;  // μ below which friction stops nothing
constexpr int kLayers = 3;    // contacts from a body that is not quiet within which all stay awake
constexpr int kChecks = 4;    // that a part of a cluster must pass before it sleeps; and between two trials
constexpr double kHolds = 4;  // [1] of the tolerance: larger gaps hold nothing at rest
// A certificate of rest is tried where forces are off balance by less than that part of gravity, and the
// speed is less than that part of what friction stops in a step.
constexpr double kLoose = 0x1p-4;
constexpr double kSlow = 0x1p-3;
constexpr int kRestSweeps = 200;
constexpr double kRestChange = 0x1p-3;  // [1] of the tolerated imbalance: change that re-solves neighbours

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
  std::vector<char> quiet(bodies_.size(), 1);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!isQuiet(i, kFeasible, 1)) {
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
    freezeParts();
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

// At rest, or nearly so: the forces of the last step balanced but for that part of gravity, and its speed is
// that part of what friction stops in a step.
bool Crowd::isQuiet(std::size_t place, double imbalance, double part) const {
  const PileBody& body = bodies_[place];
  const double speed = body.velocity.norm() + body.radius * body.omega.norm();
  return body.still() || (unrest_[place] <= imbalance * gravityMagnitude_ * h_ &&
                          speed <= part * grip_[place] * gravityMagnitude_ * h_);
}

// One restless body keeps only those awake that are a few contacts from it. The others sleep if forces within
// their cones balance on each of them, those of the ones awake being what they were in the last step.
void Crowd::freezeParts() {
  std::vector<char> calm(bodies_.size(), 1);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    calm[i] = isQuiet(i, kLoose, kSlow) ? 1 : 0;
  }
  keepFar(calm);
  bool any = false;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    quietChecks_[i] = bodies_[i].still() || calm[i] == 0 ? 0 : quietChecks_[i] + 1;
    calm[i] = quietChecks_[i] >= kChecks ? 1 : 0;
    any = any || calm[i] != 0;
  }
  if (++checks_ % kChecks != 0 || !any) {
    return;
  }
  certify(calm);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (calm[i] != 0) {
      PileBody& body = bodies_[i];
      body.asleep = true;
      body.cluster = static_cast<int>(i);
      body.velocity = body.angularMomentum = body.omega = Vec3::Zero();
      ++figures_.frozen;
    }
  }
}

// Leaves those marked that are more than kLayers contacts from one that is not.
void Crowd::keepFar(std::vector<char>& marked) const {
  std::vector<int> layer(bodies_.size(), kLayers + 1);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (marked[i] == 0) {
      layer[i] = 0;
    }
  }
  for (int next = 1; next <= kLayers; ++next) {
    for (const int slot : near_) {
      const PileManifold& manifold = manifolds_[at(slot)];
      if (!manifold.b.isWall() && !bodies_[at(manifold.a)].held && !bodyAt(manifold.b).held) {
        const std::size_t a = at(manifold.a);
        const std::size_t b = at(manifold.b.body());
        layer[b] = layer[a] == next - 1 ? std::min(layer[b], next) : layer[b];
        layer[a] = layer[b] == next - 1 ? std::min(layer[a], next) : layer[a];
      }
    }
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    marked[i] = layer[i] > kLayers ? 1 : 0;
  }
}

// Solves a step of the chosen bodies from rest. Those that stay at rest in it, and are far from those that do
// not, stay chosen, and keep its impulses.
void Crowd::certify(std::vector<char>& chosen) {
  const double balanced = kFeasible * gravityMagnitude_ * h_;
  solver_.begin(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (chosen[i] != 0) {
      solver_.setBody(static_cast<int>(i), bodies_[i], kRestChange * balanced);
      solver_.velocity(static_cast<int>(i)) = span_ * acceleration(i);
    }
  }
  const auto isChosen = [&](Partner partner) { return !partner.isWall() && chosen[at(partner.body())] != 0; };
  std::vector<int> slots;
  for (const int slot : near_) {
    PileManifold& manifold = manifolds_[at(slot)];
    const bool a = chosen[at(manifold.a)] != 0;
    const bool b = isChosen(manifold.b);
    if (!a && !b) {
      continue;
    }
    const bool meetsMoving = (!a && !bodies_[at(manifold.a)].still()) ||
                             (!b && !manifold.b.isWall() && !bodyAt(manifold.b).still());
    if (meetsMoving) {
      const Vec3 apart = bodies_[at(manifold.a)].position - bodyAt(manifold.b).position;
      for (int k = 0; k < manifold.count; ++k) {
        const PilePoint& point = manifold.points[at(k)];
        const Vec3 impulse = impulseOf(manifold, k);
        if (a) {
          solver_.push(manifold.a, point.world, impulse);
        } else {
          solver_.push(manifold.b.body(), point.world + apart, -impulse);
        }
      }
      continue;
    }
    slots.push_back(slot);
    for (int k = 0; k < manifold.count; ++k) {  // it may be a new one since the step was solved
      PilePoint& point = manifold.points[at(k)];
      point.row = point.gap < kHolds * tolerance_ ? 0 : -1;
    }
    addPresentRows(manifold);
  }
  solver_.link();
  solver_.warmStart();
  solver_.wakeAll();
  figures_.solves += solver_.solve(kRestSweeps, true);
  std::vector<char> resting(bodies_.size(), 1);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const int index = static_cast<int>(i);
    const double speed =
        chosen[i] == 0 ? 0 : solver_.velocity(index).norm() + bodies_[i].radius * solver_.omega(index).norm();
    resting[i] = speed <= balanced ? 1 : 0;
  }
  keepFar(resting);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    chosen[i] = chosen[i] != 0 && resting[i] != 0 ? 1 : 0;
  }
  restoreImpulses(slots, chosen);
}

// Of the manifolds in the solver, those at bodies that fall asleep keep its impulses.
void Crowd::restoreImpulses(const std::vector<int>& slots, const std::vector<char>& sleeping) {
  int row = 0;
  for (const int slot : slots) {
    PileManifold& manifold = manifolds_[at(slot)];
    const bool sleeps =
        sleeping[at(manifold.a)] != 0 || (!manifold.b.isWall() && sleeping[at(manifold.b.body())] != 0);
    for (int k = 0; k < manifold.count; ++k) {
      PilePoint& point = manifold.points[at(k)];
      if (point.row < 0) {
        continue;
      }
      if (sleeps) {
        point.normalImpulse = solver_.normalImpulse(row);
        point.tangential1 = solver_.tangential1(row);
        point.tangential2 = solver_.tangential2(row);
      }
      ++row;
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
Vec3 Crowd::forceOf(const PileManifold& manifold) {
  Vec3 impulse = Vec3::Zero();
  for (int k = 0; k < manifold.count; ++k) {
    impulse += impulseOf(manifold, k);
  }
  return impulse / manifold.span;
}

// [N s] On a, in the last step.
Vec3 Crowd::impulseOf(const PileManifold& manifold, int k) {
  const PilePoint& point = manifold.points[at(k)];
  const ContactFrame& frame = manifold.frameOf(k);
  return point.normalImpulse * frame.normal + point.tangential1 * frame.tangent1 +
         point.tangential2 * frame.tangent2;
}

void Crowd::findDisturbed() {
  disturbed_.clear();
  for (const std::size_t k : besideSleep_) {
    PileManifold& manifold = manifolds_[at(pairs_.pairs()[k].slot)];
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

// Wakes what an impulse of this step went through as if it were a wall: the step is to be solved anew.
bool Crowd::wakeStruck() {
  bool woke = false;
  for (const std::size_t n : besideSleep_) {
    const PileManifold& manifold = manifolds_[at(pairs_.pairs()[n].slot)];
    if (!isHalfAsleep(manifold)) {
      continue;
    }
    Vec3 impulse = Vec3::Zero();
    for (int k = 0; k < manifold.count; ++k) {
      const int row = manifold.points[at(k)].row;
      impulse += row < 0 ? Vec3(Vec3::Zero()) : Vec3(solver_.normalImpulse(row) * manifold.frameOf(k).normal);
    }
    const PileBody& sleeper = bodies_[at(manifold.a)].asleep ? bodies_[at(manifold.a)] : bodyAt(manifold.b);
    const Vec3 carried = manifold.carries ? manifold.carried : Vec3(Vec3::Zero());
    const double load = carried.norm() + gravityMagnitude_ / sleeper.inverseMass;
    if ((impulse / span_ - carried).norm() > kStrike * load) {
      wakeCluster(sleeper.cluster);
      woke = true;
    }
  }
  if (woke) {
    wakeNeighbours();
  }
  return woke;
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

}  // namespace careen
