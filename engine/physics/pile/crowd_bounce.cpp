#include "physics/pile/crowd_bounce.h"

#include <algorithm>
#include <cmath>

#include "core/disjoint_sets.h"
#include "physics/pile/crowd_motion.h"

namespace careen {
namespace {

constexpr int kBounceSweeps = 20;

}  // namespace

void CrowdBounces::find() {
  bounces_.clear();
  for (const int slot : contacts_.near()) {
    findOf(contacts_[slot], slot);
  }
}

// Only the part of gravity before the time of contact counts, or bouncing would gain energy. Speeds are those
// of the middle.
void CrowdBounces::findOf(const PileManifold& manifold, int slot) {
  for (int k = 0; manifold.strikes && k < manifold.count; ++k) {
    const PilePoint& point = manifold.points[at(k)];
    if (point.row < 0 || !point.strikes) {
      continue;
    }
    const double before = std::clamp(point.gap / (-point.speed * members_.h), 0.0, 1.0);
    const auto falling = [&](int body) {
      return members_[body].still() ? Vec3(Vec3::Zero()) : loads_.acceleration(at(body));
    };
    const double fall =
        members_.h * dot(manifold.frameOf(k).normal, falling(manifold.a) - falling(manifold.b));
    const double approach = std::max(0.0, -(point.speed + (before - 0.5) * fall));
    bounces_.push_back({.row = point.row,
                        .speed = manifold.restitution * approach,
                        .approach = approach,
                        .fall = fall,
                        .slot = slot,
                        .point = k});
  }
}

void CrowdBounces::bounce(CrowdImpulses& impulses) {
  PileSolver& solver = impulses.solver();
  const bool any = std::any_of(bounces_.begin(), bounces_.end(), [&](const Bounce& each) {
    return each.speed > 0 && solver.normalImpulse(each.row) > 0;
  });
  if (any) {
    solve(impulses);
  }
  note(solver);
}

void CrowdBounces::solve(CrowdImpulses& impulses) {
  PileSolver& solver = impulses.solver();
  for (const int slot : contacts_.near()) {
    contacts_.refresh(contacts_[slot]);
  }
  solver.begin(members_.size());
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const PileBody& body = members_[i];
    solver.setBody(static_cast<int>(i), body, memory_.tell * body.length / members_.h);
    if (!body.still()) {
      solver.velocity(static_cast<int>(i)) = body.velocity;
      solver.omega(static_cast<int>(i)) = body.omega;
    }
  }
  for (const int slot : contacts_.near()) {
    contacts_.addPresentRows(contacts_[slot], solver);
  }
  solver.link();
  for (const Bounce& each : bounces_) {
    if (each.speed > 0 && solver.normalImpulse(each.row) > 0) {
      solver.setBound(each.row, each.speed - 0.5 * each.fall);
      solver.wakeRow(each.row);
    }
  }
  if (!impulses.solveDirectly()) {
    solver.solve(kBounceSweeps);
  }
  limit(solver);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const int index = static_cast<int>(i);
    if (solver.pushed(index)) {
      PileBody& body = members_[i];
      takeVelocity(body, solver.velocity(index), solver.omega(index));
      body.angularMomentum += body.behind * loads_.torque(i);
      deriveOmega(body);
      body.velocity += loads_.halfKick(i);
      body.behind = 0;
    }
  }
}

// Restitution at several contacts at once, with friction, can give more energy than there was: bodies that
// bounce together then get that part of the second solve's change that keeps their energy. Friction cones are
// convex, so both solves' impulses mixed lie in them.
void CrowdBounces::limit(PileSolver& solver) const {
  DisjointSets together(members_.size());
  const auto moves = [&](int body) { return at(body) < members_.size() && !members_[body].still(); };
  const int rows = static_cast<int>(solver.rowCount());
  for (int k = 0; k < rows; ++k) {
    const PileSolver::RowView row = solver.row(k);
    if (moves(row.a) && moves(row.b)) {
      together.join(at(row.a), at(row.b));
    }
  }
  std::vector<Energies> energies(members_.size());
  const auto kinetic = [](const PileBody& body, const Vec3& velocity, const Vec3& omega) {
    const Vec3 spin = body.principalAxes().transpose() * omega;
    return 0.5 * (velocity.squaredNorm() / body.inverseMass + dot(body.inertiaBody, spin.cwiseProduct(spin)));
  };
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const int index = static_cast<int>(i);
    const PileBody& body = members_[i];
    if (body.still() || !solver.pushed(index)) {
      continue;
    }
    Energies& all = energies[together.root(i)];
    const CrowdMembers::Way& before = members_.ways[i];
    const double turning = 0.5 * dot(before.omega, before.angularMomentum);
    const double work = dot(loads_.acceleration(i), body.position - before.position);
    all.before += (0.5 * before.velocity.squaredNorm() + work) / body.inverseMass + turning;
    const Vec3 kick = loads_.halfKick(i);
    all.first += kinetic(body, body.velocity + kick, body.omega);
    all.second += kinetic(body, solver.velocity(index) + kick, solver.omega(index));
    all.change += kinetic(body, solver.velocity(index) - body.velocity, solver.omega(index) - body.omega);
  }
  std::vector<double> parts(members_.size(), 1);
  bool any = false;
  for (std::size_t i = 0; i < members_.size(); ++i) {
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
  for (std::size_t i = 0; any && i < members_.size(); ++i) {
    const int index = static_cast<int>(i);
    if (!members_[i].still() && solver.pushed(index)) {
      const double part = parts[together.root(i)];
      solver.velocity(index) = members_[i].velocity + part * (solver.velocity(index) - members_[i].velocity);
      solver.omega(index) = members_[i].omega + part * (solver.omega(index) - members_[i].omega);
    }
  }
}

// The total impulses of the points that met: of the first solve, or of the second, which continues it.
void CrowdBounces::note(const PileSolver& solver) {
  impacts_.clear();
  for (const Bounce& each : bounces_) {
    const PileManifold& manifold = contacts_[each.slot];
    const double impulse = solver.normalImpulse(each.row);
    if (impulse > 0) {
      const double t1 = solver.tangential1(each.row);
      const double t2 = solver.tangential2(each.row);
      const PilePoint& point = manifold.points[at(each.point)];
      impacts_.push_back({.a = manifold.a,
                          .b = manifold.b,
                          .point = members_[manifold.a].position + point.world,
                          .normal = manifold.frameOf(each.point).normal,
                          .approach = each.approach,
                          .impulse = impulse,
                          .tangential = std::sqrt(t1 * t1 + t2 * t2)});
    }
  }
}

}  // namespace careen
