#include "physics/impact/impact_problem.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/error.h"
#include "physics/geometry/contact_frame.h"
#include "physics/solver/contact_rows.h"

namespace careen {
namespace {

bool movable(const MassProperties& mass) {
  return mass.inverseMass > 0 || !mass.inverseInertiaBody.isZero(0);
}

/// Along them the mass matrix is diagonal.
Mat3 principalAxes(const ImpactBody& body) {
  return body.mass->worldFromPrincipal(body.state->pose.worldFromBody);
}

/// The impact in the coordinates of the solver: only the bodies that can move.
struct Setup {
  std::vector<int> movableOf;  // by body: index among the movable, or kNobody
  ContactProblem problem;      // free: the velocities before
};

void addBodies(Setup& setup, std::span<const ImpactBody> bodies) {
  for (const ImpactBody& body : bodies) {
    if (!movable(*body.mass)) {
      setup.movableOf.push_back(ContactProblem::kNobody);
      continue;
    }
    setup.movableOf.push_back(static_cast<int>(setup.problem.free.size() / ContactProblem::kAxes));
    const Vec3 momentumBody = principalAxes(body).transpose() * body.state->angularMomentum;
    const Vec3 spin = body.mass->inverseInertiaBody.cwiseProduct(momentumBody);
    for (Eigen::Index k = 0; k < 3; ++k) {
      setup.problem.free.push_back(body.state->velocity[k]);
      setup.problem.inverseMass.push_back(body.mass->inverseMass);
    }
    for (Eigen::Index k = 0; k < 3; ++k) {
      setup.problem.free.push_back(spin[k]);
      setup.problem.inverseMass.push_back(body.mass->inverseInertiaBody[k]);
    }
  }
}

double inverseEffectiveMass(const Setup& setup, const ContactProblem::Contact& contact) {
  std::array<double, 2> sum{};
  const std::array<int, 2> sides{contact.a, contact.b};
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t k = 0; sides[side] != ContactProblem::kNobody && k < ContactProblem::kAxes; ++k) {
      const double value = contact.rows[0][side * ContactProblem::kAxes + k];
      sum[side] +=
          setup.problem.inverseMass[static_cast<std::size_t>(sides[side]) * ContactProblem::kAxes + k] *
          (value * value);
    }
  }
  return sum[0] + sum[1];
}

void addContact(Setup& setup, std::span<const ImpactBody> bodies, const ImpactContact& contact) {
  ContactProblem::Contact added;
  const std::array<Vec3, 3> axes = frameOf(contact.normal).axes();
  const auto a = static_cast<std::size_t>(contact.a);
  added.a = setup.movableOf[a];
  setSide(added, 0, contact.rows ? contact.rows->a : pointSide(axes, contact.armA, 1),
          principalAxes(bodies[a]));
  const auto b = static_cast<std::size_t>(contact.b);
  added.b = setup.movableOf[b];
  if (added.b != ContactProblem::kNobody) {
    setSide(added, 1, contact.rows ? contact.rows->b : pointSide(axes, contact.armB, -1),
            principalAxes(bodies[b]));
  }
  const double normal = inverseEffectiveMass(setup, added);
  if (!(normal > 0) || !std::isfinite(normal)) {
    throw NumericalError(
        "impact: a contact between two sides that cannot move, or a number that is not finite");
  }
  added.friction = contact.material.friction;
  if (contact.material.surface.moves()) {
    const Vec3 surface =
        contact.material.surface.along(contact.normal, bodies[a].state->pose.position + contact.armA);
    added.target = {0, dot(axes[1], surface), dot(axes[2], surface)};
  }
  const auto addDriven = [&](std::size_t body, const Vec3& arm, double sign) {
    if (bodies[body].isDriven()) {
      const BodyState& state = *bodies[body].state;
      const Vec3 given = sign * (state.velocity + state.angularMomentum.cross(arm));
      for (std::size_t row = 0; row < axes.size(); ++row) {
        added.target[row] += dot(axes[row], given);
      }
    }
  };
  addDriven(a, contact.armA, -1);
  addDriven(b, contact.armB, 1);
  added.admissible = contact.holds ? ContactProblem::Admissible::kSpace : ContactProblem::Admissible::kCone;
  setup.problem.contacts.push_back(added);
}

}  // namespace

ContactProblem impactProblemOf(std::span<const ImpactBody> bodies, std::span<const ImpactContact> contacts) {
  Setup setup;
  addBodies(setup, bodies);
  for (const ImpactContact& contact : contacts) {
    addContact(setup, bodies, contact);
  }
  return std::move(setup.problem);
}

}  // namespace careen
