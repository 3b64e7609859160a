#include "physics/pile/crowd_problem.h"

#include "physics/pile/index.h"

namespace careen {

void CrowdProblem::begin() {
  problem_.inverseMass.clear();
  problem_.free.clear();
  problem_.contacts.clear();
  solution_.impulses.clear();
  movers_.clear();
  numbers_.assign(members_.size(), ContactProblem::kNobody);
}

int CrowdProblem::include(int place, const Vec3& velocity, const Vec3& omega) {
  const PileBody& mover = members_[place];
  if (mover.still()) {
    return ContactProblem::kNobody;
  }
  int& number = numbers_[at(place)];
  if (number == ContactProblem::kNobody) {
    number = static_cast<int>(movers_.size());
    movers_.push_back(place);
    const Vec3 spin = mover.principalAxes().transpose() * omega;
    for (int i = 0; i < 3; ++i) {
      problem_.inverseMass.push_back(mover.inverseMass);
      problem_.free.push_back(velocity[i]);
    }
    for (int i = 0; i < 3; ++i) {
      problem_.inverseMass.push_back(mover.inverseInertiaBody[i]);
      problem_.free.push_back(spin[i]);
    }
  }
  return number;
}

void CrowdProblem::add(const ContactProblem::Contact& contact, const RowSide& rowsA, const RowSide& rowsB,
                       const Triple& impulse) {
  ContactProblem::Contact& added = problem_.contacts.emplace_back(contact);
  if (added.a != ContactProblem::kNobody) {
    setSide(added, 0, rowsA, members_[movers_[at(added.a)]].principalAxes());
  }
  if (added.b != ContactProblem::kNobody) {
    setSide(added, 1, rowsB, members_[movers_[at(added.b)]].principalAxes());
  }
  solution_.impulses.push_back(impulse);
}

bool CrowdProblem::solve(ContactSolver& solver, double enough, int mostFactorisations) {
  addImpulses(-1);
  solution_.enough = enough;
  return solver.solveOnce(problem_, solution_, mostFactorisations);
}

Vec3 CrowdProblem::velocity(std::size_t number) const {
  const double* q = &solution_.velocities[number * ContactProblem::kAxes];
  return {q[0], q[1], q[2]};
}

Vec3 CrowdProblem::omega(std::size_t number) const {
  const double* q = &solution_.velocities[number * ContactProblem::kAxes];
  return members_[movers_[number]].principalAxes() * Vec3(q[3], q[4], q[5]);
}

// To the problem's velocities.
void CrowdProblem::addImpulses(double sign) {
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
