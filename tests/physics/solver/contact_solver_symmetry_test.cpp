// What must not matter: units, mirroring, and in which order things are listed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>
#include <vector>

#include "physics/solver/contact_scene.h"
#include "physics/solver/contact_solver.h"

namespace careen {
namespace {

/// A stack in which nothing is symmetric: boxes of different size and mass, some of which slide or tip.
ContactScene untidyStack() {
  ContactScene scene;
  const std::array<double, 4> velocities{0.3, -0.7, 1.1, 0.2};
  for (int k = 0; k < 4; ++k) {
    const double x = 0.1 * k;
    const double v = velocities[static_cast<std::size_t>(k)];
    scene.add(1 + 0.3 * k, {1 - 0.1 * k, 1, 0.5}, {x, 0.05 * k, k + 0.5}, {v, v * v - 0.3, -1},
              {0, 0.1 * v, -v});
    scene.touchFlat(k, k - 1, x, 0.05 * k, 0.7 - 0.1 * k, 0.6, k, 0.3);
  }
  return scene;
}

ContactSolution solved(const ContactProblem& problem) {
  ContactSolver solver;
  ContactSolution solution;
  EXPECT_TRUE(solver.solve(problem, solution));
  expectHonest(problem, solution);
  return solution;
}

TEST(ContactSolverSymmetry, powersOfTwoAsUnitsChangeNoBit) {
  const ContactProblem problem = untidyStack().problem;
  const ContactSolution solution = solved(problem);
  for (const auto& [mass, length, time] : {std::array{0x1p10, 1.0, 1.0}, std::array{1.0, 0x1p-7, 1.0},
                                           std::array{1.0, 1.0, 0x1p9}, std::array{0x1p-3, 0x1p5, 0x1p11}}) {
    ContactProblem scaled = problem;
    const double speed = length / time;
    for (std::size_t k = 0; k < scaled.free.size(); ++k) {
      const bool turns = k % 6 >= 3;
      scaled.inverseMass[k] /= turns ? mass * length * length : mass;
      scaled.free[k] *= turns ? 1 / time : speed;
    }
    for (ContactProblem::Contact& contact : scaled.contacts) {
      for (std::size_t row = 0; row < 3; ++row) {
        contact.target[row] *= speed;
        for (std::size_t k = 0; k < 12; ++k) {
          contact.rows[row][k] *= k % 6 >= 3 ? length : 1;
        }
      }
    }
    const ContactSolution found = solved(scaled);
    for (std::size_t k = 0; k < problem.free.size(); ++k) {
      EXPECT_EQ(found.velocities[k], solution.velocities[k] * (k % 6 >= 3 ? 1 / time : speed));
    }
    for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(found.impulses[c][k], solution.impulses[c][k] * (mass * speed));
      }
    }
  }
}

// x → −x: velocities along x and rotations about y and z change their sign.
TEST(ContactSolverSymmetry, mirroredProblemsHaveMirroredBits) {
  const ContactProblem problem = untidyStack().problem;
  const ContactSolution solution = solved(problem);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto sign = [axis](std::size_t k) { return (k % 6 < 3) == (k % 3 == axis) ? -1.0 : 1.0; };
    ContactProblem mirrored = problem;
    for (std::size_t k = 0; k < mirrored.free.size(); ++k) {
      mirrored.free[k] *= sign(k);
    }
    for (ContactProblem::Contact& contact : mirrored.contacts) {
      for (ContactProblem::Row& row : contact.rows) {
        for (std::size_t k = 0; k < row.size(); ++k) {
          row[k] *= sign(k);
        }
      }
    }
    const ContactSolution found = solved(mirrored);
    for (std::size_t k = 0; k < problem.free.size(); ++k) {
      EXPECT_EQ(found.velocities[k], sign(k) * solution.velocities[k]);
    }
    EXPECT_EQ(found.impulses, solution.impulses);
  }
}

TEST(ContactSolverSymmetry, orderOfTheListingChangesNoBit) {
  for (const ContactProblem& problem : {untidyStack().problem, brickWall(4, 3, 1, 0.5).problem}) {
    const bool tidy =
        problem.contacts.size() > 16;  // what symmetry exchanges may exchange its rounding errors
    const ContactSolution solution = solved(problem);
    const std::size_t bodies = problem.free.size() / 6;
    std::mt19937 generator(7);
    for (int time = 0; time < 20; ++time) {
      std::vector<std::size_t> to(bodies);
      std::iota(to.begin(), to.end(), 0U);
      std::shuffle(to.begin(), to.end(), generator);
      std::vector<std::size_t> from(problem.contacts.size());
      std::iota(from.begin(), from.end(), 0U);
      std::shuffle(from.begin(), from.end(), generator);
      ContactProblem permuted = problem;
      for (std::size_t body = 0; body < bodies; ++body) {
        std::copy_n(&problem.free[body * 6], 6, &permuted.free[to[body] * 6]);
        std::copy_n(&problem.inverseMass[body * 6], 6, &permuted.inverseMass[to[body] * 6]);
      }
      for (std::size_t c = 0; c < from.size(); ++c) {
        ContactProblem::Contact& contact = permuted.contacts[c];
        contact = problem.contacts[from[c]];
        contact.a = static_cast<int>(to[static_cast<std::size_t>(contact.a)]);
        contact.b =
            contact.b == kNobody ? kNobody : static_cast<int>(to[static_cast<std::size_t>(contact.b)]);
      }
      const ContactSolution found = solved(permuted);
      const double tolerance = tidy ? 1e-13 : 0;
      for (std::size_t body = 0; body < bodies; ++body) {
        for (std::size_t k = 0; k < 6; ++k) {
          EXPECT_NEAR(found.velocities[to[body] * 6 + k], solution.velocities[body * 6 + k], tolerance);
        }
      }
      for (std::size_t c = 0; c < from.size(); ++c) {
        EXPECT_NEAR(found.impulses[c][0], solution.impulses[from[c]][0], tidy ? 1e-9 : 0);  // redundant
      }
    }
  }
}

// A cube that lands flat must not begin to spin, not even by a rounding error.
TEST(ContactSolverSymmetry, cubeLandsFlat) {
  for (const double friction : {0.0, 0.5}) {
    const ContactScene scene = cubeStack(1, 0.7, 1.3, friction);
    const ContactSolution solution = solved(scene.problem);
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_EQ(k == 2 ? 0.0 : solution.velocities[k], 0.0);
    }
    for (const ContactProblem::Triple& impulse : solution.impulses) {
      EXPECT_EQ(impulse, solution.impulses[0]);
    }
  }
}

}  // namespace
}  // namespace careen
