// Random boxes in random contacts, wilder than scenes: every claim is checked in quadruple precision.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <iostream>
#include <random>

#include "physics/solver/contact_scene.h"
#include "physics/solver/contact_solver.h"

namespace careen {
namespace {

class ProblemDice {
 public:
  explicit ProblemDice(unsigned seed) : generator_(seed) {}
  /// Uniform in (−1, 1), the same everywhere.
  double number() { return static_cast<double>(generator_()) * 0x1p-31 - 1; }
  int upTo(int n) { return static_cast<int>(generator_() % static_cast<unsigned>(n)); }

 private:
  std::mt19937 generator_;
};

/// Bodies at random places; each contact joins a random body to another or to the world, at a random point
/// near.
ContactScene randomScene(ProblemDice& dice, int bodies, int contacts, double largeFriction) {
  ContactScene scene;
  const std::array<double, 6> frictions{0, 0.1, 0.4, 0.9, 3, largeFriction};
  constexpr std::array<double, 5> kMasses{1, 1, 2, 1e-3, 1e3};
  for (int body = 0; body < bodies; ++body) {
    const double mass = kMasses[static_cast<std::size_t>(dice.upTo(5))];
    const auto three = [&](double middle, double half) {
      std::array<double, 3> numbers{};
      for (double& number : numbers) {
        number = middle + half * dice.number();
      }
      return numbers;
    };
    const auto half = three(1, 0.5);
    const auto place = three(0, 1);
    const auto velocity = three(0, 1);
    scene.add(mass, half, place, velocity, three(0, 1));
  }
  const double friction = frictions[static_cast<std::size_t>(dice.upTo(6))];
  for (int c = 0; c < contacts; ++c) {
    const int a = c < bodies ? c : dice.upTo(bodies);
    int b = dice.upTo(bodies + 1) - 1;
    b = b == a ? ContactProblem::kNobody : b;
    std::array<double, 3> point{};
    for (double& number : point) {
      number = dice.number();
    }
    const auto axis = static_cast<std::size_t>(dice.upTo(3));
    scene.touch(a, b, point, axis, dice.upTo(2) == 0 ? -1 : 1, friction);
  }
  return scene;
}

struct SolvedTally {
  int solved = 0;
  int tight = 0;  // to 1e-12 V
  int failed = 0;
};

SolvedTally solveMany(unsigned seed, int times, int bodies, int contacts, double largeFriction = 10) {
  ProblemDice dice(seed);
  SolvedTally tally;
  ContactSolver solver;
  for (int k = 0; k < times; ++k) {
    const int most = 1 + dice.upTo(bodies);
    const ContactScene scene = randomScene(dice, most, 1 + dice.upTo(contacts), largeFriction);
    ContactSolution solution;
    solver.solve(scene.problem, solution);
    expectHonest(scene.problem, solution);
    (solution.solved ? tally.solved : tally.failed) += 1;
    tally.tight += solution.residual <= 1e-12 * solution.scale ? 1 : 0;
  }
  std::cout << tally.solved << " solved, " << tally.tight << " to 1e-12, " << tally.failed << " failed\n";
  return tally;
}

TEST(ContactSolverRandom, oneBody) {
  const SolvedTally tally = solveMany(1, 4000, 1, 4);
  EXPECT_EQ(tally.failed, 0);
  EXPECT_GE(tally.tight, 3995);
}

TEST(ContactSolverRandom, threeBodies) {
  const SolvedTally tally = solveMany(2, 2000, 3, 8);
  EXPECT_LE(tally.failed, 1);  // measured: 0
  EXPECT_GE(tally.tight, 1980);
}

// Up to 40 contacts that cross each other at random: some are beyond it.
TEST(ContactSolverRandom, tenBodies) {
  const SolvedTally tally = solveMany(3, 200, 10, 40);
  EXPECT_LE(tally.failed, 15);  // measured: 9
}

// Where a contact ought to pull, only an impulse along the surface is left, |λ_t| = 1e9 λ_n: not always
// found.
TEST(ContactSolverRandom, infiniteFriction) {
  const SolvedTally tally = solveMany(4, 1000, 1, 4, 1e9);
  EXPECT_LE(tally.failed, 8);  // measured: 4
}

}  // namespace
}  // namespace careen
