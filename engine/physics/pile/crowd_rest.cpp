// Sleeping, and penetration queries.
#include <algorithm>
#include <cmath>

#include "physics/pile/crowd.h"

namespace careen {
namespace {

constexpr double kFrictionless = 0x1p-20;  // μ below which friction stops nothing

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
    const bool pushes = std::any_of(manifold.points.begin(), manifold.points.begin() + manifold.count,
                                    [](const PilePoint& point) { return point.normalImpulse > 0; });
    if (!pushes) {
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
  const auto isQuiet = [&](std::size_t i) {
    const PileBody& body = bodies_[i];
    const double speed = body.velocity.norm() + body.radius * body.omega.norm();
    return body.asleep ||
           (unrest_[i] <= kFeasible * gravityMagnitude_ * h_ && speed <= grip_[i] * gravityMagnitude_ * h_);
  };
  std::vector<char> quiet(bodies_.size(), 1);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].held && !bodies_[i].absent && !isQuiet(i)) {
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
  return all;
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
