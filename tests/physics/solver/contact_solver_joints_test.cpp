// Joints, ropes and limits as rows of a ContactProblem: what admits every impulse, and half-lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "physics/solver/contact_scene.h"
#include "physics/solver/contact_solver.h"

namespace careen {
namespace {

using Vector = ContactScene::Vector;

ContactSolution solvedJoints(const ContactScene& scene, double residual = 1e-13) {
  ContactSolver solver;
  ContactSolution solution;
  EXPECT_TRUE(solver.solve(scene.problem, solution)) << solution.residual / solution.scale;
  EXPECT_LE(solution.residual, residual * solution.scale);
  expectHonest(scene.problem, solution);
  return solution;
}

// A cube that hangs by a corner's height above its centre, struck at v: about the pivot I = m (1/6 + d²) for
// edges of 1 m, so that ω = v d/(1/6 + d²), and the pivot takes what is missing.
TEST(ContactSolverJoints, aPendulumTurnsAboutItsPivot) {
  constexpr double kArm = 1.5;
  ContactScene scene;
  scene.add(2, {0.5, 0.5, 0.5}, {0, 0, 0}, {3, 0, 0});
  scene.join(0, kNobody, {0, 0, kArm});
  const ContactSolution solution = solvedJoints(scene);
  const double omega = -3 * kArm / (1. / 6 + kArm * kArm);
  EXPECT_NEAR(solution.velocities[4], omega, 1e-14);
  EXPECT_NEAR(solution.velocities[0], -omega * kArm, 1e-14);
  EXPECT_NEAR(solution.impulses[0][1], 2 * (-omega * kArm - 3), 1e-13);  // rows: z, x, y
  EXPECT_NEAR(solution.impulses[0][0], 0, 1e-14);
}

// Ten links, of which the last weighs 100, then 1e4 times as much: struck at its end the chain moves as its
// equations say, and linear momentum goes to the pivot alone.
TEST(ContactSolverJoints, chainsHoldWhateverTheirEndWeighs) {
  for (const double heavy : {1.0, 100.0, 1e4}) {
    ContactScene scene;
    for (int k = 0; k < 10; ++k) {
      scene.add(k == 9 ? heavy : 1, {0.5, 0.1, 0.1}, {k + 0.5, 0, 0}, {0, 0, k == 9 ? 1.0 : 0.0});
      scene.join(k, k - 1, {static_cast<double>(k), 0, 0});
    }
    const ContactSolution solution = solvedJoints(scene, 1e-12);
    double momentum = 0;
    for (std::size_t k = 0; k < 10; ++k) {
      momentum += (k == 9 ? heavy : 1) * (solution.velocities[6 * k + 2] - (k == 9 ? 1 : 0));
      EXPECT_NEAR(solution.velocities[6 * k], 0, 1e-12);  // nothing pulls along the chain
    }
    EXPECT_NEAR(solution.impulses[0][0], momentum, 1e-9 * heavy);
    EXPECT_LE(solution.factorisations, 20) << heavy;
  }
}

// Three joints on one line hold what two would. They share as their effective masses along the normal tell,
// 1/(1/3 + x²/(1/2)): 1.2, 3 and 1.2 kg.
TEST(ContactSolverJoints, redundantJointsShareAsTheirMassesTell) {
  ContactScene scene;
  scene.add(3, {0.5, 0.5, 0.5}, {0, 0, -1}, {0, 2, -1});
  for (const double x : {-0.5, 0.0, 0.5}) {
    scene.join(0, kNobody, {x, 0, 0});
  }
  const ContactSolution solution = solvedJoints(scene);
  const double omega = 2 / (1. / 6 + 1);  // about x
  EXPECT_NEAR(solution.velocities[3], omega, 1e-14);
  EXPECT_NEAR(solution.velocities[1], omega, 1e-14);
  for (std::size_t k = 0; k < 3; ++k) {
    const double share = (k == 1 ? 3 : 1.2) / 5.4;
    EXPECT_NEAR(solution.impulses[k][0], share * 3, 1e-8);  // 3 kg that fell with 1 m/s
    EXPECT_NEAR(solution.impulses[k][2], share * 3 * (omega - 2), 1e-8);
  }
}

/// A box of 2 m by 1 m by 1 m, as one or as two cubes that are welded, in any motion over the floor, which
/// its lower corners touch as `touches` tells.
ContactScene boxOnFloor(bool isOne, const Vector& v, const Vector& w, const std::array<bool, 4>& touches,
                        double friction) {
  ContactScene scene;
  const auto velocityAt = [&](double x) {  // x from the middle
    return Vector{v[0], v[1] + w[2] * x, v[2] - w[1] * x};
  };
  if (isOne) {
    scene.add(2, {1, 0.5, 0.5}, {0, 0, 0.5}, v, w);
  } else {
    scene.add(1, {0.5, 0.5, 0.5}, {-0.5, 0, 0.5}, velocityAt(-0.5), w);
    scene.add(1, {0.5, 0.5, 0.5}, {0.5, 0, 0.5}, velocityAt(0.5), w);
    scene.weld(1, 0, {0, 0.2, 0.3});
  }
  for (std::size_t k = 0; k < 4; ++k) {
    if (touches[k]) {
      const double x = k < 2 ? -1 : 1;
      scene.touch(isOne || x < 0 ? 0 : 1, kNobody, {x, k % 2 == 0 ? -0.5 : 0.5, 0}, 2, 1, friction);
    }
  }
  return scene;
}

// The sharpest test: friction and impacts pass through a weld as through a box.
TEST(ContactSolverJoints, twoHalvesThatAreWeldedMoveAsOne) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> between(-2, 2);
  int compared = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Vector v{between(random), between(random), -std::fabs(between(random))};
    const Vector w{between(random), between(random), between(random)};
    std::array<bool, 4> touches{};
    touches[static_cast<std::size_t>(trial % 4)] = true;
    touches[static_cast<std::size_t>(trial / 4 % 4)] = true;
    const double friction = trial % 3 * 0.25;
    const ContactSolution one = solvedJoints(boxOnFloor(true, v, w, touches, friction), 1e-9);
    const ContactSolution two = solvedJoints(boxOnFloor(false, v, w, touches, friction), 1e-9);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(two.velocities[3 + k], one.velocities[3 + k], 1e-8) << trial;
      EXPECT_NEAR((two.velocities[k] + two.velocities[6 + k]) / 2, one.velocities[k], 1e-8) << trial;
    }
    compared += one.impulses[0][0] > 0 ? 1 : 0;
  }
  EXPECT_GT(compared, 200);
}

// Chains with all four corners of each link on a rough floor, thrown: no answer is known, but it is checked
// in quadruple precision.
TEST(ContactSolverJoints, jointsAndFrictionAreSolvedTogether) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> between(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    ContactScene scene;
    const int links = 2 + trial % 5;
    for (int k = 0; k < links; ++k) {
      scene.add(std::exp(2 * between(random)), {0.5, 0.2, 0.2}, {k + 0.5, 0, 0.2},
                {between(random), between(random), between(random) - 0.5},
                {between(random), between(random), between(random)});
      scene.touchFlat(k, kNobody, k + 0.5, 0, 0.5, 0.2, 0, 0.3 + 0.3 * between(random));
      if (k > 0) {
        scene.join(k, k - 1, {static_cast<double>(k), 0, 0.2});
      }
    }
    solvedJoints(scene, 1e-9);
  }
}

// A rope is a row without friction along its own line: taut it stops what goes away, and pulls nothing back.
TEST(ContactSolverJoints, aRopeIsAHalfLine) {
  for (const double away : {-1.0, 2.0}) {
    ContactScene scene;
    scene.add(1, {0.1, 0.1, 0.1}, {0, 0, 0}, {away, 3, 0});
    ContactProblem::Contact rope{.a = 0};
    rope.rows[0][0] = -1;  // the way that is left, L − |d|
    scene.problem.contacts.push_back(rope);
    const ContactSolution solution = solvedJoints(scene);
    EXPECT_NEAR(solution.velocities[0], std::min(away, 0.0), 1e-15);
    EXPECT_EQ(solution.velocities[1], 3);
    EXPECT_NEAR(solution.impulses[0][0], std::max(away, 0.0), 1e-15);
  }
}

// A row along x of at most 2 N s either way, that keeps to 0.5 m/s, of 1 kg: it brings to it what is within
// 2 m/s, the rest nearer by 2 m/s.
TEST(ContactSolverJoints, anIntervalKeepsToItsSpeedAsFarAsItReaches) {
  for (const double speed : {-4.0, -1.0, 0.5, 2.0, 7.0}) {
    ContactScene scene;
    scene.add(1, {0.1, 0.1, 0.1}, {0, 0, 0}, {speed, 3, 0});
    ContactProblem::Contact grip{.a = 0,
                                 .target = {0.5, 0, 0},
                                 .admissible = ContactProblem::Admissible::kInterval,
                                 .least = -2,
                                 .most = 2};
    grip.rows[0][0] = 1;
    scene.problem.contacts.push_back(grip);
    const ContactSolution solution = solvedJoints(scene);
    const double impulse = std::clamp(0.5 - speed, -2.0, 2.0);
    EXPECT_NEAR(solution.velocities[0], speed + impulse, 1e-15);
    EXPECT_EQ(solution.velocities[1], 3);
    EXPECT_NEAR(solution.impulses[0][0], impulse, 1e-15);
  }
}

// Links whose joints have dry friction, on a rough floor: each of their rows is at an end of its interval
// where it slips, in quadruple precision.
TEST(ContactSolverJoints, intervalsAndFrictionAreSolvedTogether) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> between(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    ContactScene scene;
    const int links = 2 + trial % 5;
    for (int k = 0; k < links; ++k) {
      scene.add(std::exp(2 * between(random)), {0.5, 0.2, 0.2}, {k + 0.5, 0, 0.2},
                {between(random), between(random), between(random) - 0.5},
                {between(random), between(random), between(random)});
      scene.touchFlat(k, kNobody, k + 0.5, 0, 0.5, 0.2, 0, 0.3 + 0.3 * between(random));
      if (k > 0) {
        scene.join(k, k - 1, {static_cast<double>(k), 0, 0.2});
        const double most = std::exp(3 * between(random) - 3);
        ContactProblem::Contact grip{.a = k,
                                     .b = k - 1,
                                     .target = {0.2 * between(random), 0, 0},
                                     .admissible = ContactProblem::Admissible::kInterval,
                                     .least = -most,
                                     .most = most};
        grip.rows[0][4] = 0.5;
        grip.rows[0][10] = -0.5;
        scene.problem.contacts.push_back(grip);
      }
    }
    solvedJoints(scene, 1e-9);
  }
}

// A limit turns and does not push: only the spin about its axis changes, of both sides together.
TEST(ContactSolverJoints, aLimitTurnsBothSides) {
  ContactScene scene;
  scene.add(6, {0.5, 0.5, 0.5}, {0, 0, 0}, {1, 2, 3}, {0.5, -2, 0.25});  // 1 kg m²
  scene.add(12, {0.5, 0.5, 0.5}, {1, 0, 0}, {-3, 0, 0}, {0, 1, 0});      // 2 kg m²
  ContactProblem::Contact limit{.a = 0, .b = 1};
  limit.rows[0][4] = 1;
  limit.rows[0][10] = -1;
  scene.problem.contacts.push_back(limit);
  const ContactSolution solution = solvedJoints(scene);
  EXPECT_NEAR(solution.velocities[4], 0, 1e-15);  // (−2 + 2·1)/3
  EXPECT_NEAR(solution.velocities[10], 0, 1e-15);
  EXPECT_NEAR(solution.impulses[0][0], 2, 1e-14);
  for (const std::size_t k : {0U, 1U, 2U, 3U, 5U, 6U, 7U, 8U, 9U, 11U}) {
    EXPECT_EQ(solution.velocities[k], scene.problem.free[k]);
  }
}

}  // namespace
}  // namespace careen
