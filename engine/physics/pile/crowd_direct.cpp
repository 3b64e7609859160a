#include "physics/pile/crowd_direct.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "physics/pile/index.h"
#include "physics/solver/contact_rows.h"

namespace careen {
namespace {

/// Of more contact points Gauss–Seidel costs less than factorisations do.
constexpr std::size_t kMostRows = 600;
constexpr int kMostFactorisations = 60;
/// Of more than kFewRows in violent motion it does too: they get fewer, and one try in so many solves.
constexpr int kFewFactorisations = 12;
constexpr int kMostWait = 32;
/// [1] Of a belt's speed: less of it along the normal is rounding.
constexpr double kAlong = 0x1p-40;
/// [1] Ratio of masses in contact from which Gauss–Seidel takes too long.
constexpr double kHeavy = 16;
/// [1] of the tolerance: what the residual of a step may move a body by in it.
constexpr double kResidual = 0x1p-10;

}  // namespace

// Whether of two members in contact one is much heavier.
bool CrowdDirect::isHeavy() const {
  return std::any_of(contacts_.near().begin(), contacts_.near().end(), [&](int slot) {
    const PileManifold& manifold = contacts_[slot];
    if (members_[manifold.a].still() || members_[manifold.b].still()) {
      return false;
    }
    const double ratio = members_[manifold.a].inverseMass / members_[manifold.b].inverseMass;
    return std::max(ratio, 1 / ratio) > kHeavy;
  });
}

double CrowdDirect::enough() const { return kResidual * members_.tolerance / members_.h; }

bool CrowdDirect::solve(PileSolver& solver) {
  const std::size_t count = solver.rowCount();
  if (count > kMostRows || (count == 0 && !articulations_.any())) {
    return false;
  }
  const bool easy = count <= kFewRows || isHeavy();
  if (!easy && memory_.directWait > 0) {
    --memory_.directWait;
    return false;
  }
  problem_.begin();
  addRows(solver);
  articulations_.addTo(problem_, solver);
  const bool solved = problem_.solve(solver_, enough(), easy ? kMostFactorisations : kFewFactorisations);
  memory_.directPause = easy || solved ? 1 : std::min(2 * memory_.directPause, kMostWait);
  memory_.directWait = easy || solved ? 0 : memory_.directPause;
  if (!solved) {
    return false;
  }
  for (std::size_t m = 0; m < problem_.movers().size(); ++m) {
    const int body = problem_.movers()[m];
    solver.velocity(body) = problem_.velocity(m);
    solver.omega(body) = problem_.omega(m);
  }
  for (std::size_t k = 0; k < count; ++k) {
    solver.setImpulse(static_cast<int>(k), problem_.impulses()[k]);
  }
  takeJoints(solver, count);
  return true;
}

// What they push is pushed.
void CrowdDirect::takeJoints(PileSolver& solver, std::size_t first) {
  if (!articulations_.any()) {
    return;
  }
  articulations_.take(std::span(problem_.impulses()).subspan(first));
  for (const int body : problem_.movers()) {
    if (articulations_.isJoined(body)) {
      solver.setPushed(body, solver.velocity(body), solver.omega(body));
    }
  }
}

double CrowdDirect::solveJoints(PileSolver& solver) {
  problem_.begin();
  articulations_.addTo(problem_, solver);
  if (problem_.movers().empty() || !problem_.solve(ofJoints_, enough(), kMostFactorisations)) {
    return 0;
  }
  double most = 0;
  for (std::size_t m = 0; m < problem_.movers().size(); ++m) {
    const int body = problem_.movers()[m];
    most = std::max(most, (problem_.velocity(m) - solver.velocity(body)).norm() +
                              members_[body].radius * (problem_.omega(m) - solver.omega(body)).norm());
    solver.setPushed(body, problem_.velocity(m), problem_.omega(m));
  }
  articulations_.take(problem_.impulses());
  return most;
}

// Bodies of the solver that are no members.
bool CrowdDirect::isBelt(int body) const { return at(body) >= members_.size(); }

// [m/s] Of its point at that arm.
Vec3 CrowdDirect::beltAt(const PileSolver& solver, int body, const Vec3& arm) const {
  return isBelt(body) ? Vec3(solver.velocity(body) + solver.omega(body).cross(arm)) : Vec3(Vec3::Zero());
}

void CrowdDirect::addRows(const PileSolver& solver) {
  for (std::size_t k = 0; k < solver.rowCount(); ++k) {
    const PileSolver::RowView row = solver.row(static_cast<int>(k));
    const auto include = [&](int body) {
      return isBelt(body) ? ContactProblem::kNobody
                          : problem_.include(body, solver.velocity(body), solver.omega(body));
    };
    const int a = include(row.a);
    const int b = include(row.b);
    const Vec3 ofBelts = beltAt(solver, row.b, row.armB) - beltAt(solver, row.a, row.armA);
    const double closing = dot(row.axes[0], ofBelts);  // of what is driven; rounding, of what moves along
    problem_.add({.a = a,
                  .b = b,
                  .friction = row.friction,
                  .target = {row.bound + (std::fabs(closing) > kAlong * ofBelts.norm() ? closing : 0),
                             dot(row.axes[1], ofBelts), dot(row.axes[2], ofBelts)}},
                 pointSide(row.axes, row.armA, 1), pointSide(row.axes, row.armB, -1), row.impulse);
  }
}

}  // namespace careen
