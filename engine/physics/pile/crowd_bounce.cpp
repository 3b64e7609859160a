// Restitution of a crowd, and its record.
#include <algorithm>
#include <cmath>

#include "core/disjoint_sets.h"
#include "physics/pile/crowd.h"

namespace careen {
namespace {

constexpr int kBounceSweeps = 20;

}  // namespace

// New impacts separate with e times their approach speed: a second solve after the motion, at the new
// positions (otherwise the angular momentum about each other is not conserved), starting from the impulses of
// the first. Its velocities are those of the end of the step, to which forces act on all that are pushed.
void Crowd::bounce() {
  const bool any = std::any_of(bounces_.begin(), bounces_.end(), [&](const Bounce& each) {
    return each.speed > 0 && solver_.normalImpulse(each.row) > 0;
  });
  if (!any) {
    return;
  }
  refreshNear();
  solver_.begin(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const PileBody& body = bodies_[i];
    solver_.setBody(static_cast<int>(i), body, tell_ * body.length / h_);
    if (!body.still()) {
      solver_.velocity(static_cast<int>(i)) = body.velocity;
      solver_.omega(static_cast<int>(i)) = body.omega;
    }
  }
  for (const int slot : near_) {
    addPresentRows(manifolds_[at(slot)]);
  }
  solver_.link();
  for (const Bounce& each : bounces_) {
    if (each.speed > 0 && solver_.normalImpulse(each.row) > 0) {
      solver_.setBound(each.row, each.speed - 0.5 * each.fall);
      solver_.wakeRow(each.row);
    }
  }
  if (!solveDirectly()) {
    figures_.solves += solver_.solve(kBounceSweeps, true);
  }
  limitBounce();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (solver_.pushed(static_cast<int>(i))) {
      takeVelocity(bodies_[i], static_cast<int>(i));
      bodies_[i].angularMomentum += bodies_[i].behind * torque(i);
      deriveOmega(bodies_[i]);
      bodies_[i].velocity += halfKick(i);
      bodies_[i].behind = 0;
    }
  }
}

// Restitution at several contacts at once, with friction, can give more energy than there was: bodies that
// bounce together then get that part of the second solve's change that keeps their energy. Friction cones are
// convex, so both solves' impulses mixed lie in them.
void Crowd::limitBounce() {
  struct Energies {
    double before = 0;  // [J] kinetic, at the start of the step, and what forces did in it
    double first = 0;   // after the first solve
    double second = 0;
    double change = 0;  // of the velocities that the second solve adds
  };
  DisjointSets together(bodies_.size());
  const auto moves = [&](int body) { return at(body) < bodies_.size() && !bodies_[at(body)].still(); };
  const int rows = static_cast<int>(solver_.rowCount());
  for (int k = 0; k < rows; ++k) {
    const PileSolver::RowView row = solver_.row(k);
    if (moves(row.a) && moves(row.b)) {
      together.join(at(row.a), at(row.b));
    }
  }
  std::vector<Energies> energies(bodies_.size());
  const auto kinetic = [](const PileBody& body, const Vec3& velocity, const Vec3& omega) {
    const Vec3 spin = body.principalAxes().transpose() * omega;
    return 0.5 * (velocity.squaredNorm() / body.inverseMass + dot(body.inertiaBody, spin.cwiseProduct(spin)));
  };
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const int index = static_cast<int>(i);
    const PileBody& body = bodies_[i];
    if (body.still() || !solver_.pushed(index)) {
      continue;
    }
    Energies& all = energies[together.root(i)];
    const Before& before = before_[i];
    const double turning = 0.5 * dot(before.omega, before.angularMomentum);
    const double work = dot(acceleration(i), body.position - before.position);
    all.before += (0.5 * before.velocity.squaredNorm() + work) / body.inverseMass + turning;
    const Vec3 kick = halfKick(i);
    all.first += kinetic(body, body.velocity + kick, body.omega);
    all.second += kinetic(body, solver_.velocity(index) + kick, solver_.omega(index));
    all.change += kinetic(body, solver_.velocity(index) - body.velocity, solver_.omega(index) - body.omega);
  }
  std::vector<double> parts(bodies_.size(), 1);
  bool any = false;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Energies& all = energies[i];
    const double most = std::max(all.before, all.first);
    if (all.second > most && all.change > 0) {
      // first + part · slope + part² · change = most
      const double slope = all.second - all.first - all.change;
      const double root = std::sqrt(std::max(0.0, slope * slope + 4 * all.change * (most - all.first)));
      parts[i] = std::clamp((root - slope) / (2 * all.change), 0.0, 1.0);
      any = true;
    }
  }
  for (std::size_t i = 0; any && i < bodies_.size(); ++i) {
    const int index = static_cast<int>(i);
    if (!bodies_[i].still() && solver_.pushed(index)) {
      const double part = parts[together.root(i)];
      solver_.velocity(index) = bodies_[i].velocity + part * (solver_.velocity(index) - bodies_[i].velocity);
      solver_.omega(index) = bodies_[i].omega + part * (solver_.omega(index) - bodies_[i].omega);
    }
  }
}

// The total impulses of the points that met: of the first solve, or of the second, which continues it.
void Crowd::noteImpacts() {
  impacts_.clear();
  for (const Bounce& each : bounces_) {
    const PileManifold& manifold = manifolds_[at(each.slot)];
    const double impulse = solver_.normalImpulse(each.row);
    if (impulse > 0) {
      const double t1 = solver_.tangential1(each.row);
      const double t2 = solver_.tangential2(each.row);
      const PilePoint& point = manifold.points[at(each.point)];
      impacts_.push_back({.a = manifold.a,
                          .b = manifold.b,
                          .point = bodies_[at(manifold.a)].position + point.world,
                          .normal = manifold.frameOf(each.point).normal,
                          .approach = each.approach,
                          .impulse = impulse,
                          .tangential = std::sqrt(t1 * t1 + t2 * t2)});
    }
  }
}

// Updates gaps to the current poses, without rebuilding.
void Crowd::refreshNear() {
  for (const int slot : near_) {
    PileManifold& manifold = manifolds_[at(slot)];
    const PileBody& a = bodies_[at(manifold.a)];
    if (manifold.b.isWall()) {
      refreshManifold(a, wallAt(manifold.b), manifold);
    } else {
      refreshManifold(a, bodyAt(manifold.b), manifold);
    }
  }
}

}  // namespace careen
