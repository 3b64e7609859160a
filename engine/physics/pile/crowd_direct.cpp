#include "physics/pile/crowd_direct.h"

#include <algorithm>
#include <cstddef>

#include "physics/solver/contact_rows.h"

namespace careen {
namespace {

/// Of more contact points Gauss–Seidel costs less than factorisations do.
constexpr std::size_t kMostRows = 600;
constexpr int kMostFactorisations = 60;
/// Of more than kFewRows in violent motion it does too: they get fewer, and one try in so many solves.
constexpr int kFewFactorisations = 12;
constexpr int kMostWait = 32;
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

bool CrowdDirect::solve(PileSolver& solver) {
  const std::size_t count = solver.rowCount();
  if (count == 0 || count > kMostRows) {
    return false;
  }
  const bool easy = count <= kFewRows || isHeavy();
  if (!easy && memory_.directWait > 0) {
    --memory_.directWait;
    return false;
  }
  const std::vector<std::size_t> movers = pose(solver);
  solution_.enough = kResidual * members_.tolerance / members_.h;
  const bool solved = solver_.solveOnce(problem_, solution_, easy ? kMostFactorisations : kFewFactorisations);
  memory_.directPause = easy || solved ? 1 : std::min(2 * memory_.directPause, kMostWait);
  memory_.directWait = easy || solved ? 0 : memory_.directPause;
  if (!solved) {
    return false;
  }
  for (std::size_t m = 0; m < movers.size(); ++m) {
    const double* q = &solution_.velocities[m * ContactProblem::kAxes];
    const int body = static_cast<int>(movers[m]);
    solver.velocity(body) = Vec3(q[0], q[1], q[2]);
    solver.omega(body) = members_[movers[m]].principalAxes() * Vec3(q[3], q[4], q[5]);
  }
  for (std::size_t k = 0; k < count; ++k) {
    solver.setImpulse(static_cast<int>(k), solution_.impulses[k]);
  }
  return true;
}

// The problem of its rows; returns the places of the bodies that can move, in the problem's order.
std::vector<std::size_t> CrowdDirect::pose(const PileSolver& solver) {
  std::vector<int> index(members_.size(), ContactProblem::kNobody);
  std::vector<std::size_t> movers;
  problem_.inverseMass.clear();
  problem_.free.clear();
  const auto indexOf = [&](int body) {
    if (members_[body].still()) {
      return ContactProblem::kNobody;
    }
    if (index[at(body)] < 0) {
      const PileBody& mover = members_[body];
      index[at(body)] = static_cast<int>(movers.size());
      movers.push_back(at(body));
      const Vec3 spin = mover.principalAxes().transpose() * solver.omega(body);
      for (int i = 0; i < 3; ++i) {
        problem_.inverseMass.push_back(mover.inverseMass);
        problem_.free.push_back(solver.velocity(body)[i]);
      }
      for (int i = 0; i < 3; ++i) {
        problem_.inverseMass.push_back(mover.inverseInertiaBody[i]);
        problem_.free.push_back(spin[i]);
      }
    }
    return index[at(body)];
  };
  const std::size_t count = solver.rowCount();
  problem_.contacts.assign(count, {});
  solution_.impulses.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const PileSolver::RowView row = solver.row(static_cast<int>(k));
    ContactProblem::Contact& contact = problem_.contacts[k];
    contact.a = indexOf(row.a);
    contact.b = indexOf(row.b);
    contact.friction = row.friction;
    contact.target = {row.bound, 0, 0};
    solution_.impulses[k] = row.impulse;
    if (contact.a != ContactProblem::kNobody) {
      setSide(contact, 0, pointSide(row.axes, row.armA, 1), members_[row.a].principalAxes());
    }
    if (contact.b != ContactProblem::kNobody) {
      setSide(contact, 1, pointSide(row.axes, row.armB, -1), members_[row.b].principalAxes());
    }
  }
  addImpulses(-1);
  return movers;
}

// To the problem's velocities.
void CrowdDirect::addImpulses(double sign) {
  for (std::size_t k = 0; k < problem_.contacts.size(); ++k) {
    const ContactProblem::Contact& contact = problem_.contacts[k];
    for (std::size_t d = 0; d < 3; ++d) {
      const auto push = [&](int body, std::size_t from) {
        for (std::size_t i = 0; body >= 0 && i < ContactProblem::kAxes; ++i) {
          const std::size_t number = at(body) * ContactProblem::kAxes + i;
          problem_.free[number] +=
              sign * problem_.inverseMass[number] * contact.rows[d][from + i] * solution_.impulses[k][d];
        }
      };
      push(contact.a, 0);
      push(contact.b, ContactProblem::kAxes);
    }
  }
}

}  // namespace careen
