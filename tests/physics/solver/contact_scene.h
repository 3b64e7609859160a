#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "physics/solver/contact_problem.h"
#include "support/quad.h"

namespace careen {

inline constexpr int kNobody = ContactProblem::kNobody;

/// Boxes without rotation that touch each other and the world, as a ContactProblem; for tests.
class ContactScene {
 public:
  using Vector = std::array<double, 3>;

  ContactProblem problem;

  /// `half`: half the edges [m]. Returns the body's index.
  int add(double mass, const Vector& half, const Vector& place, const Vector& velocity,
          const Vector& spin = {}) {
    problem.inverseMass.insert(problem.inverseMass.end(), 3, 1 / mass);
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = half[(k + 1) % 3];
      const double y = half[(k + 2) % 3];
      problem.inverseMass.push_back(3 / (mass * (x * x + y * y)));
    }
    problem.free.insert(problem.free.end(), velocity.begin(), velocity.end());
    problem.free.insert(problem.free.end(), spin.begin(), spin.end());
    places_.push_back(place);
    return static_cast<int>(places_.size()) - 1;
  }

  /// A contact at `point` whose normal, +1 or −1 along `axis`, points from b to a.
  ContactProblem::Contact& touch(int a, int b, const Vector& point, std::size_t axis, double sign,
                                 double friction) {
    ContactProblem::Contact contact{.a = a, .b = b, .friction = friction};
    for (std::size_t row = 0; row < 3; ++row) {
      Vector direction{};
      direction[(axis + row) % 3] = row == 0 ? sign : 1;
      fill(contact.rows[row], 0, a, point, direction, 1);
      fill(contact.rows[row], 6, b, point, direction, -1);
    }
    problem.contacts.push_back(contact);
    return problem.contacts.back();
  }

  /// A point of a that stays at the same one of b.
  ContactProblem::Contact& join(int a, int b, const Vector& point) {
    ContactProblem::Contact& joint = touch(a, b, point, 2, 1, 0);
    joint.admissible = ContactProblem::Admissible::kSpace;
    return joint;
  }

  /// a and b move as one.
  void weld(int a, int b, const Vector& point) {
    join(a, b, point);
    ContactProblem::Contact turning{.a = a, .b = b, .admissible = ContactProblem::Admissible::kSpace};
    for (std::size_t row = 0; row < 3; ++row) {
      turning.rows[row][3 + row] = 1;
      turning.rows[row][9 + row] = b == ContactProblem::kNobody ? 0 : -1;
    }
    problem.contacts.push_back(turning);
  }

  /// Four contacts at the corners of a rectangle at height z.
  void touchFlat(int a, int b, double x, double y, double halfX, double halfY, double z, double friction) {
    for (const double i : {-1.0, 1.0}) {
      for (const double j : {-1.0, 1.0}) {
        touch(a, b, {x + i * halfX, y + j * halfY, z}, 2, 1, friction);
      }
    }
  }

 private:
  void fill(ContactProblem::Row& row, std::size_t first, int body, const Vector& point,
            const Vector& direction, double sign) const {
    if (body == ContactProblem::kNobody) {
      return;
    }
    const Vector& place = places_[static_cast<std::size_t>(body)];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3;
      const std::size_t j = (k + 2) % 3;
      row[first + k] = sign * direction[k];
      row[first + 3 + k] =
          sign * ((point[i] - place[i]) * direction[j] - (point[j] - place[j]) * direction[i]);
    }
  }

  std::vector<Vector> places_;
};

/// n equal cubes of 1 m on each other and on the floor, after a time h of free fall that starts from rest.
inline ContactScene cubeStack(int n, double mass, double speed, double friction) {
  ContactScene scene;
  for (int k = 0; k < n; ++k) {
    scene.add(mass, {0.5, 0.5, 0.5}, {0, 0, k + 0.5}, {0, 0, -speed});
    scene.touchFlat(k, k - 1, 0, 0, 0.5, 0.5, k, friction);
  }
  return scene;
}

/// A wall in running bond: bricks of 2 m by 1 m by 1 m, `columns` of them in each row, every other row moved
/// by half a brick; each brick rests on the two below.
inline ContactScene brickWall(int rows, int columns, double speed, double friction) {
  ContactScene scene;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double x = 2 * column + row % 2;
      const int brick = scene.add(1, {1, 0.5, 0.5}, {x, 0, row + 0.5}, {0, 0, -speed});
      if (row == 0) {
        scene.touchFlat(brick, ContactProblem::kNobody, x, 0, 1, 0.5, 0, friction);
        continue;
      }
      for (const int other : {column + row % 2 - 1, column + row % 2}) {
        if (other >= 0 && other < columns) {
          const double below = 2 * other + (row - 1) % 2;
          scene.touchFlat(brick, (row - 1) * columns + other, (x + below) / 2, 0, 0.5, 0.5, row, friction);
        }
      }
    }
  }
  return scene;
}

/// What ContactSolution claims, recomputed in quadruple precision from the problem and the impulses alone.
struct Verified {
  double residual = 0;  ///< [m/s] as ImpulseSet::violation defines it
  double velocities = 0;  ///< [m/s, rad/s] largest difference between q₀ + M⁻¹Jᵀλ and the velocities given
  double cone = 0;        ///< [m/s] how far λ/mass is outside its cone
  double speed = 0;       ///< [m/s] S of ContactResiduals
  ContactResiduals residuals;
};

inline Verified verified(const ContactProblem& problem, const ContactSolution& solution) {
  std::vector<Quad> q(problem.free.begin(), problem.free.end());
  const auto forSides = [](const ContactProblem::Contact& contact, const auto& action) {
    for (const std::size_t side : {0U, 1U}) {
      if (const int body = side == 0 ? contact.a : contact.b; body != ContactProblem::kNobody) {
        for (std::size_t k = 0; k < 6; ++k) {
          action(static_cast<std::size_t>(body) * 6 + k, side * 6 + k);
        }
      }
    }
  };
  for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
    forSides(problem.contacts[c], [&](std::size_t at, std::size_t i) {
      for (std::size_t row = 0; row < 3; ++row) {
        q[at] += Quad(problem.inverseMass[at]) * problem.contacts[c].rows[row][i] * solution.impulses[c][row];
      }
    });
  }
  Verified result;
  Quad largest = 0;  // Λ
  for (const ContactProblem::Triple& l : solution.impulses) {
    largest = std::max(largest, Quad(sqrt(Quad(l[0]) * l[0] + Quad(l[1]) * l[1] + Quad(l[2]) * l[2])));
  }
  Quad primal = 0;
  Quad dual = 0;
  Quad power = 0;
  Quad speed = 0;
  for (std::size_t k = 0; k < q.size(); ++k) {
    result.velocities =
        std::max(result.velocities, std::fabs(static_cast<double>(q[k] - solution.velocities[k])));
  }
  for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
    const ContactProblem::Contact& contact = problem.contacts[c];
    std::array<Quad, 3> u{Quad(-contact.target[0]), Quad(-contact.target[1]), Quad(-contact.target[2])};
    Quad inverse = 0;
    forSides(contact, [&](std::size_t at, std::size_t i) {
      inverse += Quad(problem.inverseMass[at]) * contact.rows[0][i] * contact.rows[0][i];
      for (std::size_t row = 0; row < 3; ++row) {
        u[row] += q[at] * contact.rows[row][i];
      }
    });
    std::array<Quad, 3> before{Quad(-contact.target[0]), Quad(-contact.target[1]), Quad(-contact.target[2])};
    forSides(contact, [&](std::size_t at, std::size_t i) {
      for (std::size_t row = 0; row < 3; ++row) {
        const Quad part = Quad(problem.free[at]) * contact.rows[row][i];
        before[row] += part;
        speed = std::max(speed, Quad(abs(part)));
      }
    });
    speed =
        std::max(speed, Quad(sqrt(before[0] * before[0] + before[1] * before[1] + before[2] * before[2])));
    for (const double target : contact.target) {
      speed = std::max(speed, Quad(std::fabs(target)));
    }
    const auto& [n, t, s] = solution.impulses[c];
    if (contact.admissible == ContactProblem::Admissible::kSpace) {
      const Quad size = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
      primal = std::max(primal, size);
      power = std::max(power, Quad(abs(n * u[0] + t * u[1] + s * u[2])));
      result.residual = std::max(result.residual, static_cast<double>(size));
      continue;
    }
    if (contact.admissible == ContactProblem::Admissible::kInterval) {
      const Quad x = n - u[0] / inverse;
      const Quad admitted = std::min(std::max(x, Quad(contact.least)), Quad(contact.most));
      const Quad outside = std::max(Quad(contact.least) - n, n - Quad(contact.most));
      dual = std::max(dual, outside);
      power = std::max(power, Quad(abs((n - Quad(u[0] > 0 ? contact.least : contact.most)) * u[0])));
      result.residual = std::max(result.residual, static_cast<double>(abs(n - admitted) * inverse));
      result.cone = std::max(result.cone, static_cast<double>(outside * inverse));
      continue;
    }
    const bool slips = contact.admissible == ContactProblem::Admissible::kLine;
    primal = std::max(primal, Quad(-u[0]));
    Quad lost = n * u[0];
    Quad beyond = -Quad(n);
    const Quad limit = Quad(contact.friction) * n;
    if (slips || !(contact.friction > 0)) {
      const Quad x = t + (slips ? Quad(limit * contact.slip[0]) : Quad(0));
      const Quad y = s + (slips ? Quad(limit * contact.slip[1]) : Quad(0));
      beyond = std::max(beyond, Quad(sqrt(x * x + y * y)));
    } else {
      beyond = std::max(beyond, Quad(sqrt(Quad(t) * t + Quad(s) * s) - limit));
      lost += std::min(limit, largest) * sqrt(u[1] * u[1] + u[2] * u[2]) + t * u[1] + s * u[2];
    }
    dual = std::max(dual, beyond);
    power = std::max(power, Quad(abs(lost)));
    std::array<Quad, 3> l{};
    for (std::size_t k = 0; k < 3; ++k) {
      l[k] = inverse * solution.impulses[c][k];
    }
    const Quad open = l[0] - u[0] > 0 ? u[0] : l[0];
    Quad square = open * open;
    Quad outside = l[0] < 0 ? Quad(-l[0]) : Quad(0);
    if (slips || !(contact.friction > 0)) {
      for (std::size_t k = 0; k < 2; ++k) {
        const Quad off = l[1 + k] + (slips ? contact.friction * contact.slip[k] * l[0] : Quad(0));
        outside = std::max(outside, Quad(abs(off)));
      }
    } else {
      const Quad x = l[1] - u[1];
      const Quad y = l[2] - u[2];
      const Quad size = sqrt(x * x + y * y);
      const Quad radius = contact.friction * (l[0] > 0 ? l[0] : Quad(0));
      const Quad shrink = size > radius ? Quad(radius / size) : Quad(1);
      square += (l[1] - shrink * x) * (l[1] - shrink * x) + (l[2] - shrink * y) * (l[2] - shrink * y);
      outside = std::max(outside, Quad(sqrt(l[1] * l[1] + l[2] * l[2]) - radius));
    }
    result.residual = std::max(result.residual, static_cast<double>(sqrt(square)));
    result.cone = std::max(result.cone, static_cast<double>(outside));
  }
  result.speed = static_cast<double>(speed);
  result.residuals = {
      .problems = 1,
      .primal = speed > 0 ? static_cast<double>(primal / speed) : 0,
      .dual = largest > 0 ? static_cast<double>(dual / largest) : 0,
      .complementarity = speed > 0 && largest > 0 ? static_cast<double>(power / speed / largest) : 0};
  return result;
}

/// What every solution must be, whoever asked for it: in its cones, with the velocities that follow, and with
/// the residual it claims, all to rounding errors.
inline void expectHonest(const ContactProblem& problem, const ContactSolution& solution) {
  const Verified truth = verified(problem, solution);
  double speed = solution.scale;
  double load = 0;
  for (std::size_t k = 0; k < problem.free.size(); ++k) {
    speed = std::max({speed, std::fabs(problem.free[k]), std::fabs(solution.velocities[k])});
  }
  for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
    const double invere = *std::max_element(problem.inverseMass.begin(), problem.inverseMass.end());
    for (const double part : solution.impulses[c]) {
      load = std::max(load, std::fabs(part) * invere);
    }
  }
  const double rounding = 0x1p-46 * (speed + load);
  EXPECT_NEAR(truth.residual, solution.residual, rounding);
  EXPECT_LE(truth.velocities, rounding);
  EXPECT_LE(truth.cone, rounding);
  // Relative to S they are as exact as the velocities; its parts are multiplied by rows of any size.
  const double relative = truth.speed > 0 ? 4 * rounding / truth.speed : 0;
  EXPECT_NEAR(truth.residuals.primal, solution.residuals.primal, relative);
  EXPECT_NEAR(truth.residuals.dual, solution.residuals.dual, 0x1p-48);
  EXPECT_NEAR(truth.residuals.complementarity, solution.residuals.complementarity, 2 * relative + 0x1p-48);
  if (solution.solved) {
    EXPECT_LE(truth.residual, 1.001e-9 * solution.scale + rounding);
  }
}

}  // namespace careen
