#include "physics/pile/crowd_bounce.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/disjoint_sets.h"
#include "physics/pile/belts.h"
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

Vec3 CrowdBounces::falling(int body) const {
  return members_[body].still() ? Vec3(Vec3::Zero()) : loads_.acceleration(at(body));
}

// [m/s] By which forces change the normal speed in the step.
double CrowdBounces::fallOf(const PileManifold& manifold, int point) const {
  return members_.h * dot(manifold.frameOf(point).normal, falling(manifold.a) - falling(manifold.b));
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
    const double approach = std::max(0.0, -(point.speed + (before - 0.5) * fallOf(manifold, k)));
    bounces_.push_back({.approach = approach, .slot = slot, .point = k});
  }
}

void CrowdBounces::bounce(CrowdImpulses& impulses) {
  PileSolver& solver = impulses.solver();
  if (resolve()) {
    solve(impulses);
  }
  note(solver);
}

// Whether restitution adds anything.
bool CrowdBounces::resolve() {
  const bool elastic = std::any_of(bounces_.begin(), bounces_.end(),
                                   [&](const Bounce& each) {
                                     return contacts_[each.slot].points[at(each.point)].normalImpulse > 0;
                                   }) &&
                       std::any_of(contacts_.near().begin(), contacts_.near().end(),
                                   [&](int slot) { return contacts_[slot].material.restitution > 0; });
  if (!elastic) {
    return false;
  }
  findClosed();
  restitution_.begin();
  double strongest = 0;  // [m/s²]
  for (const Bounce& each : bounces_) {
    const PileManifold& manifold = contacts_[each.slot];
    if (manifold.points[at(each.point)].normalImpulse > 0) {
      strongest = std::max({strongest, falling(manifold.a).norm(), falling(manifold.b).norm()});
      restitution_.strike(each.slot, each.point, each.approach);
    }
  }
  restitution_.resolve(kStrikesFrom * strongest * members_.h);
  return std::any_of(restitution_.bodies().begin(), restitution_.bodies().end(),
                     [](const ReachedBody& body) { return body.moves(); });
}

// Rows of what touches after the motion, or pushed in it. What is still open meets in a later step.
void CrowdBounces::findClosed() {
  int next = 0;
  for (const int slot : contacts_.near()) {
    PileManifold& manifold = contacts_[slot];
    contacts_.refresh(manifold);
    for (int k = 0; k < manifold.count; ++k) {
      PilePoint& point = manifold.points[at(k)];
      const bool closed =
          point.row >= 0 && (point.gap <= kTogether * members_.tolerance || point.normalImpulse > 0);
      point.row = closed ? next++ : -1;
    }
  }
}

void CrowdBounces::solve(CrowdImpulses& impulses) {
  PileSolver& solver = impulses.solver();
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
  articulations_.keepRates();
  beginFrom(solver);
  if (!impulses.solveDirectly()) {
    impulses.sweep(kBounceSweeps);
  }
  giveBack(solver);
  impulses.solveJoints();
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

// The solver's velocities are those without what restitution adds, and normal speeds relative to that. What
// impulses reached begins with those of the law, and of what does not strike also those by which it was
// supported before.
void CrowdBounces::beginFrom(PileSolver& solver) {
  for (const ReachedPoint& point : restitution_.points()) {
    const PileManifold& manifold = contacts_[point.slot];
    const PilePoint& from = manifold.points[at(point.index)];
    const PileSolver::RowView row = solver.row(from.row);
    const bool acts = point.whole > 0;
    solver.setBound(from.row, acts ? std::max(0.0, point.afterPlastic) - 0.5 * fallOf(manifold, point.index)
                                   : row.bound - point.added);
    if (acts || point.plastic > 0) {
      const double support = point.strikes ? 0 : std::min(from.normalImpulse, from.normalImpulseBefore);
      const std::array<double, 3> impulse{std::max(0.0, point.whole) + support, row.impulse[1],
                                          row.impulse[2]};
      const Vec3 more = (impulse[0] - row.impulse[0]) * row.axes[0];
      solver.push(row.a, row.armA, more);
      solver.push(row.b, row.armB, -more);
      solver.setImpulse(from.row, impulse);
    }
    solver.wakeRow(from.row);
  }
  for (const ReachedBody& body : restitution_.bodies()) {
    solver.velocity(body.place) -= body.velocity;
    solver.omega(body.place) -= body.omega;
  }
}

// The law is that of the places of now, the impulses of the step are those of its start: of the energy that
// these took from bodies that bounce together restitution gives back the same part as in the law.
void CrowdBounces::giveBack(PileSolver& solver) const {
  const std::span<const ReachedBody> bodies = restitution_.bodies();
  DisjointSets together(bodies.size());
  for (const ReachedPoint& point : restitution_.points()) {
    const auto [a, b] = point.bodies;
    if (a != ReachedContacts::kNobody && b != ReachedContacts::kNobody && point.whole != point.plastic) {
      together.join(at(a), at(b));
    }
  }
  std::vector<Energies> energies(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    addEnergies(bodies[k], solver, energies[together.root(k)]);
  }
  for (const ReachedPoint& point : restitution_.points()) {
    const int body = point.bodies[0] == ReachedContacts::kNobody ? point.bodies[1] : point.bodies[0];
    if (body != ReachedContacts::kNobody) {
      Energies& all = energies[together.root(at(body))];
      all.taken += point.taken;
      all.before += workOfBelt(point, solver);
      const double added = (point.whole - point.plastic) * drivenSpeed(point);
      all.before -= added;
      all.slope -= added;
    }
  }
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const ReachedBody& body = bodies[k];
    if (!body.moves()) {
      continue;
    }
    const double part = energies[together.root(k)].part();
    solver.setPushed(body.place, solver.velocity(body.place) + part * body.velocity,
                     solver.omega(body.place) + part * body.omega);
  }
}

// [J] That a surface that moves did in the step: what impulses take is that more than what is missing.
double CrowdBounces::workOfBelt(const ReachedPoint& point, const PileSolver& solver) const {
  const PileManifold& manifold = contacts_[point.slot];
  const PilePoint& at = manifold.points[careen::at(point.index)];
  if (!isOnBelt(members_, manifold) || at.row < 0) {
    return 0;
  }
  const ContactFrame& frame = manifold.frameOf(point.index);
  const bool isDriven = members_[manifold.a].isDriven() || members_[manifold.b].isDriven();
  const Vec3 impulse = frame.inWorld(
      {isDriven ? solver.normalImpulse(at.row) : 0, solver.tangential1(at.row), solver.tangential2(at.row)});
  return dot(impulse, velocityOfBelt(members_, manifold, frame, at));
}

// [m/s] Along the normal, of something driven: what restitution adds is relative to it, and none of what it
// did before.
double CrowdBounces::drivenSpeed(const ReachedPoint& point) const {
  const PileManifold& manifold = contacts_[point.slot];
  if (!members_[manifold.a].isDriven() && !members_[manifold.b].isDriven()) {
    return 0;
  }
  return dot(point.normal, velocityOfBelt(members_, manifold, manifold.frameOf(point.index),
                                          manifold.points[careen::at(point.index)]));
}

void CrowdBounces::addEnergies(const ReachedBody& reached, const PileSolver& solver, Energies& all) const {
  if (!reached.moves()) {
    return;
  }
  const PileBody& body = members_[reached.place];
  const CrowdMembers::Way& before = members_.ways[at(reached.place)];
  const Mat3 axes = body.principalAxes();
  const auto product = [&](const Vec3& v, const Vec3& w, const Vec3& otherV, const Vec3& otherW) {
    return dot(v, otherV) / body.inverseMass +
           dot(body.inertiaBody, Vec3(axes.transpose() * w).cwiseProduct(axes.transpose() * otherW));
  };
  const Vec3 velocity = solver.velocity(reached.place) + loads_.halfKick(at(reached.place));
  const Vec3& omega = solver.omega(reached.place);
  const double work = dot(loads_.acceleration(at(reached.place)), body.position - before.position);
  all.before += (0.5 * before.velocity.squaredNorm() + work) / body.inverseMass +
                0.5 * dot(before.omega, before.angularMomentum);
  all.without += 0.5 * product(velocity, omega, velocity, omega);
  all.slope += product(velocity, omega, reached.velocity, reached.omega);
  all.change += 0.5 * product(reached.velocity, reached.omega, reached.velocity, reached.omega);
}

// [1] Of what restitution adds by the law.
double CrowdBounces::Energies::part() const {
  const double lost = before - without;
  const double wanted = taken > 0 ? std::min(1.0, (slope + change) / taken) * lost : 0;
  if (!(change > 0) || !(wanted > 0)) {
    return 0;
  }
  return (std::sqrt(std::max(0.0, slope * slope + 4 * change * wanted)) - slope) / (2 * change);
}

// The total impulses of the points that met: of the first solve, or of the second, which continues it.
void CrowdBounces::note(const PileSolver& solver) {
  impacts_.clear();
  for (const Bounce& each : bounces_) {
    const PileManifold& manifold = contacts_[each.slot];
    const PilePoint& point = manifold.points[at(each.point)];
    const double impulse = point.row < 0 ? 0 : solver.normalImpulse(point.row);
    if (impulse > 0) {
      const double t1 = solver.tangential1(point.row);
      const double t2 = solver.tangential2(point.row);
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
