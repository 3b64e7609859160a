#include "physics/pile/crowd_sleep.h"

#include <algorithm>
#include <cmath>

namespace careen {
namespace {

constexpr double kFeasible = 0x1p-10;  // [1] of gravity: tolerated force imbalance of a body at rest
// [1] of a body's weight and of what another pushes it with: change of the latter that wakes it; and change
// that is a strike, to which it must not have been a wall.
constexpr double kMayChange = 0x1p-3;
constexpr double kStrike = 4;
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

// [N s] On a, in the last step.
Vec3 impulseOf(const PileManifold& manifold, int k) {
  const PilePoint& point = manifold.points[at(k)];
  const ContactFrame& frame = manifold.frameOf(k);
  return point.normalImpulse * frame.normal + point.tangential1 * frame.tangent1 +
         point.tangential2 * frame.tangent2;
}

// [N] On a, in the last step.
Vec3 forceOf(const PileManifold& manifold) {
  Vec3 impulse = Vec3::Zero();
  for (int k = 0; k < manifold.count; ++k) {
    impulse += impulseOf(manifold, k);
  }
  return impulse / manifold.span;
}

}  // namespace

CrowdSleep::CrowdSleep(CrowdMembers& members, const CrowdLoads& loads, CrowdContacts& contacts,
                       const CrowdArticulations& articulations, CrowdMemory& memory)
    : members_(members),
      loads_(loads),
      contacts_(contacts),
      articulations_(articulations),
      memory_(memory),
      solver_(members.team) {}

// Whether the moving body would push the sleeping one by more than the tolerated imbalance at rest, or strike
// it, if forces between them are part of the balance: how those change is known after the step.
bool CrowdSleep::wouldPush(const PilePair& pair) const {
  const PileManifold& manifold = contacts_[pair.slot];
  const PileBody& a = members_[pair.a];
  const PileBody& b = members_[pair.b];
  const auto speed = [&](const PileBody& body, const Vec3& arm) {
    return body.isDriven() ? Vec3(body.velocity + body.omega.cross(arm))
           : body.still()  ? Vec3(Vec3::Zero())
                          : Vec3(body.velocity + members_.h * members_.world.gravity + body.omega.cross(arm));
  };
  const double heavy = a.asleep ? a.inverseMass : b.inverseMass;
  const double light = a.asleep ? b.inverseMass : a.inverseMass;
  for (int k = 0; k < manifold.count; ++k) {
    const PilePoint& point = manifold.points[at(k)];
    const Vec3 relative = speed(a, point.world) - speed(b, point.world + a.position - b.position);
    const double approach =
        -dot(manifold.frameOf(k).normal, relative) - std::max(0.0, point.gap) / members_.h;
    const double tolerated = manifold.carries ? kStrikesFrom : kFeasible * (heavy + light) / heavy;
    if (approach > tolerated * members_.gravity * members_.h) {
      return true;
    }
  }
  return false;
}

// Of two that can move, one sleeps.
bool CrowdSleep::isHalfAsleep(const PileManifold& manifold) const {
  const PileBody& a = members_[manifold.a];
  const PileBody& b = members_[manifold.b];
  return !a.held() && !b.held() && a.asleep != b.asleep;
}

// Of the two of a manifold that is half asleep.
const PileBody& CrowdSleep::sleeperOf(const PileManifold& manifold) const {
  return members_[manifold.a].asleep ? members_[manifold.a] : members_[manifold.b];
}

// Whether the force [N] on a differs from what it carried by so many times that and the sleeper's weight.
bool CrowdSleep::changes(const PileManifold& manifold, const Vec3& force, const Vec3& carried,
                         double times) const {
  const double load = carried.norm() + members_.gravity / sleeperOf(manifold).inverseMass;
  return (force - carried).norm() > times * load;
}

void CrowdSleep::findDisturbed() {
  memory_.disturbed.clear();
  for (const std::size_t k : contacts_.besideSleep()) {
    PileManifold& manifold = contacts_[contacts_.pairs()[k].slot];
    if (!manifold.carries) {
      continue;
    }
    if (!isHalfAsleep(manifold)) {
      manifold.carries = false;
      continue;
    }
    if (changes(manifold, forceOf(manifold), manifold.carried, kMayChange)) {
      memory_.disturbed.push_back(sleeperOf(manifold).cluster);
    }
  }
}

void CrowdSleep::wakeDisturbed() {
  for (std::size_t i = 0; articulations_.any() && i < members_.size(); ++i) {
    if (members_[i].asleep && articulations_.mayChange(static_cast<int>(i))) {
      memory_.disturbed.push_back(members_[i].cluster);
    }
  }
  if (memory_.disturbed.empty()) {
    return;
  }
  for (const int cluster : memory_.disturbed) {
    wakeCluster(cluster);
  }
  memory_.disturbed.clear();
  wakeNeighbours();
}

bool CrowdSleep::wakePushed() {
  bool woke = false;
  for (const std::size_t k : contacts_.besideSleep()) {
    const PilePair& pair = contacts_.pairs()[k];
    const PileBody& a = members_[pair.a];
    if ((a.asleep || members_[pair.b].asleep) && wouldPush(pair)) {
      wakeCluster(a.asleep ? a.cluster : members_[pair.b].cluster);
      woke = true;
    }
  }
  if (woke) {
    wakeNeighbours();
  }
  return woke;
}

bool CrowdSleep::wakeStruck(const PileSolver& solver) {
  bool woke = false;
  for (const std::size_t n : contacts_.besideSleep()) {
    const PileManifold& manifold = contacts_[contacts_.pairs()[n].slot];
    if (!isHalfAsleep(manifold)) {
      continue;
    }
    Vec3 impulse = Vec3::Zero();
    for (int k = 0; k < manifold.count; ++k) {
      const int row = manifold.points[at(k)].row;
      impulse += row < 0 ? Vec3(Vec3::Zero()) : Vec3(solver.normalImpulse(row) * manifold.frameOf(k).normal);
    }
    const Vec3 carried = manifold.carries ? manifold.carried : Vec3(Vec3::Zero());
    if (changes(manifold, impulse / members_.span, carried, kStrike)) {
      wakeCluster(sleeperOf(manifold).cluster);
      woke = true;
    }
  }
  if (woke) {
    wakeNeighbours();
  }
  return woke;
}

void CrowdSleep::forgetWoken() { std::fill(woken_.begin(), woken_.end(), 0); }

void CrowdSleep::wakeCluster(int cluster) {
  woken_.resize(members_.size());
  for (std::size_t i = 0; i < members_.size(); ++i) {
    PileBody& body = members_[i];
    if (body.asleep && body.cluster == cluster) {
      body.asleep = false;
      body.cluster = -1;
      woken_[i] = 1;
      memory_.places[i].quietChecks = 0;
    }
  }
}

// Those a few contacts from one that was woken: where a part of a cluster slept, it wakes by parts.
void CrowdSleep::wakeNeighbours() {
  std::vector<int> clusters;
  for (int layer = 0; layer < kLayers; ++layer) {
    clusters.clear();
    for (const PilePair& pair : contacts_.pairs()) {
      if (pair.slot < 0 || !isHalfAsleep(contacts_[pair.slot])) {
        continue;
      }
      const PileBody& a = members_[pair.a];
      if (woken_[at(a.asleep ? pair.b : pair.a)] != 0 && pushes(contacts_[pair.slot])) {
        clusters.push_back(a.asleep ? a.cluster : members_[pair.b].cluster);
      }
    }
    for (const int cluster : clusters) {
      wakeCluster(cluster);
    }
  }
}

// Bodies that push each other, or sleep together.
void CrowdSleep::findClusters() {
  grip_.assign(members_.size(), kFrictionless);
  isCarried_.assign(members_.size(), isGravitySloping(members_.world) ? 1 : 0);
  clusters_.reset(members_.size());
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_[i].asleep) {
      clusters_.join(i, at(members_[i].cluster));
    }
  }
  for (const int slot : contacts_.near()) {
    const PileManifold& manifold = contacts_[slot];
    if (!pushes(manifold)) {
      continue;
    }
    const std::size_t a = at(manifold.a);
    const std::size_t b = at(manifold.b);
    grip_[a] = std::max(grip_[a], manifold.material.friction);
    grip_[b] = std::max(grip_[b], manifold.material.friction);
    isCarried_[a] = isCarried_[a] != 0 || members_[b].isDriven() ? 1 : 0;
    isCarried_[b] = isCarried_[b] != 0 || members_[a].isDriven() ? 1 : 0;
    if (!members_[a].held() && !members_[b].held()) {
      clusters_.join(a, b);
    }
  }
  joinArticulations();
}

// They sleep as one, and what holds one of them holds all.
void CrowdSleep::joinArticulations() {
  if (!articulations_.any()) {
    return;
  }
  DisjointSets joined(members_.size());
  const auto moves = [&](int place) {
    return place < CrowdArticulations::kOutside && !members_[place].held();
  };
  for (const CrowdArticulations::Listed& joint : articulations_.joints()) {
    if (moves(joint.a) && moves(joint.b)) {
      joined.join(at(joint.a), at(joint.b));
      clusters_.join(at(joint.a), at(joint.b));
    }
  }
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 0; i < members_.size(); ++i) {
      raiseTo(grip_[round == 0 ? joined.root(i) : i], grip_[round == 0 ? i : joined.root(i)]);
    }
  }
}

bool CrowdSleep::freeze() {
  findClusters();
  std::vector<char> quiet(members_.size(), 1);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!isQuiet(i, kFeasible, 1) || articulations_.mayChange(static_cast<int>(i))) {
      quiet[clusters_.root(i)] = 0;
    }
  }
  bool all = true;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const PileBody& body = members_[i];
    const std::size_t root = clusters_.root(i);
    if (body.held() || body.absent || (body.asleep && quiet[root] == 0)) {
      continue;
    }
    if (quiet[root] == 0) {
      all = false;
      continue;
    }
    freeze(i, static_cast<int>(root));
  }
  if (!all) {
    freezeParts();
  }
  for (const int slot : contacts_.near()) {
    PileManifold& manifold = contacts_[slot];
    const bool sleeps = members_[manifold.a].asleep || members_[manifold.b].asleep;
    if (sleeps && !manifold.carries) {
      manifold.carried = forceOf(manifold);
    }
    manifold.carries = sleeps;
  }
  return all;
}

void CrowdSleep::freeze(std::size_t place, int cluster) {
  PileBody& body = members_[place];
  body.asleep = true;
  body.cluster = cluster;
  body.velocity = body.angularMomentum = body.omega = Vec3::Zero();
}

// At rest, or nearly so: the forces of the last step balanced but for that part of gravity, and its speed is
// that part of what friction stops in a step. What touches something driven never is, and nothing where
// gravity slopes.
bool CrowdSleep::isQuiet(std::size_t place, double imbalance, double part) const {
  const PileBody& body = members_[place];
  const double speed = body.velocity.norm() + body.radius * body.omega.norm();
  return body.still() || (isCarried_[place] == 0 &&
                          members_.ways[place].unrest <= imbalance * members_.gravity * members_.h &&
                          speed <= part * grip_[place] * members_.gravity * members_.h);
}

// One restless body keeps only those awake that are a few contacts from it. The others sleep if forces within
// their cones balance on each of them, those of the ones awake being what they were in the last step.
void CrowdSleep::freezeParts() {
  std::vector<char> calm(members_.size(), 1);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    calm[i] = isQuiet(i, kLoose, kSlow) && !articulations_.isJoined(static_cast<int>(i)) ? 1 : 0;
  }
  keepFar(calm);
  bool any = false;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    memory_.places[i].quietChecks =
        members_[i].still() || calm[i] == 0 ? 0 : memory_.places[i].quietChecks + 1;
    calm[i] = memory_.places[i].quietChecks >= kChecks ? 1 : 0;
    any = any || calm[i] != 0;
  }
  if (++memory_.checks % kChecks != 0 || !any) {
    return;
  }
  certify(calm);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (calm[i] != 0) {
      freeze(i, static_cast<int>(i));
    }
  }
}

// Leaves those marked that are more than kLayers contacts from one that is not.
void CrowdSleep::keepFar(std::vector<char>& marked) const {
  std::vector<int> layer(members_.size(), kLayers + 1);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (marked[i] == 0) {
      layer[i] = 0;
    }
  }
  for (int next = 1; next <= kLayers; ++next) {
    for (const int slot : contacts_.near()) {
      const PileManifold& manifold = contacts_[slot];
      const std::size_t a = at(manifold.a);
      const std::size_t b = at(manifold.b);
      if (!members_[a].held() && !members_[b].held()) {
        layer[b] = layer[a] == next - 1 ? std::min(layer[b], next) : layer[b];
        layer[a] = layer[b] == next - 1 ? std::min(layer[a], next) : layer[a];
      }
    }
  }
  for (std::size_t i = 0; i < members_.size(); ++i) {
    marked[i] = layer[i] > kLayers ? 1 : 0;
  }
}

// Solves a step of the chosen bodies from rest. Those that stay at rest in it, and are far from those that do
// not, stay chosen, and keep its impulses.
void CrowdSleep::certify(std::vector<char>& chosen) {
  const double balanced = kFeasible * members_.gravity * members_.h;
  solver_.begin(members_.size());
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (chosen[i] != 0) {
      solver_.setBody(static_cast<int>(i), members_[i], kRestChange * balanced);
      solver_.velocity(static_cast<int>(i)) = members_.span * loads_.acceleration(i);
    }
  }
  std::vector<int> slots;
  for (const int slot : contacts_.near()) {
    PileManifold& manifold = contacts_[slot];
    const bool a = chosen[at(manifold.a)] != 0;
    const bool b = chosen[at(manifold.b)] != 0;
    if (!a && !b) {
      continue;
    }
    if ((!a && !members_[manifold.a].still()) || (!b && !members_[manifold.b].still())) {
      pushWithLast(manifold, a ? manifold.a : manifold.b);
      continue;
    }
    slots.push_back(slot);
    for (int k = 0; k < manifold.count; ++k) {  // it may be a new one since the step was solved
      PilePoint& point = manifold.points[at(k)];
      point.row = point.gap < kHolds * members_.tolerance ? 0 : -1;
    }
    contacts_.addPresentRows(manifold, solver_);
  }
  solver_.link();
  solver_.warmStart();
  solver_.wakeAll();
  solver_.solve(kRestSweeps);
  std::vector<char> resting(members_.size(), 1);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const int index = static_cast<int>(i);
    const double speed =
        chosen[i] == 0 ? 0
                       : solver_.velocity(index).norm() + members_[i].radius * solver_.omega(index).norm();
    resting[i] = speed <= balanced ? 1 : 0;
  }
  keepFar(resting);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    chosen[i] = chosen[i] != 0 && resting[i] != 0 ? 1 : 0;
  }
  restoreImpulses(slots, chosen);
}

// One of its bodies, in the solver, with what the other pushed it with in the last step.
void CrowdSleep::pushWithLast(const PileManifold& manifold, int body) {
  const Vec3 apart = members_.apart(manifold.a, manifold.b);
  for (int k = 0; k < manifold.count; ++k) {
    const Vec3& arm = manifold.points[at(k)].world;
    const Vec3 impulse = impulseOf(manifold, k);
    if (body == manifold.a) {
      solver_.push(body, arm, impulse);
    } else {
      solver_.push(body, arm + apart, -impulse);
    }
  }
}

// Of the manifolds in the solver, those at bodies that fall asleep keep its impulses.
void CrowdSleep::restoreImpulses(const std::vector<int>& slots, const std::vector<char>& sleeping) {
  int row = 0;
  for (const int slot : slots) {
    PileManifold& manifold = contacts_[slot];
    const bool sleeps = sleeping[at(manifold.a)] != 0 || sleeping[at(manifold.b)] != 0;
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

}  // namespace careen
