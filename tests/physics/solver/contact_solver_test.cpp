#include "physics/solver/contact_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "physics/solver/contact_scene.h"
#include "support/without_traps.h"

namespace careen {
namespace {

ContactSolution solved(const ContactScene& scene) {
  ContactSolver solver;
  ContactSolution solution;
  EXPECT_TRUE(solver.solve(scene.problem, solution)) << solution.residual / solution.scale;
  EXPECT_LE(solution.residual, 1e-13 * solution.scale);
  expectHonest(scene.problem, solution);
  return solution;
}

/// A box, 2 m by 2 m by 1 m and of 3 kg, on an incline whose frame is used; gravity acts for 1 s.
ContactScene onIncline(double down, double into, double friction) {
  ContactScene scene;
  scene.add(3, {1, 1, 0.5}, {0, 0, 0.5}, {down, 0, -into});
  scene.touchFlat(0, kNobody, 0, 0, 1, 1, 0, friction);
  return scene;
}

// μ = 0.6 > tan: rests. N = m·4, T = m·2; T acts 0.5 m below the centre and moves N's centre by 0.5 T/N =
// 0.25 m downhill: the two corners there carry (1 + 0.25)/2 of N, the others (1 − 0.25)/2.
TEST(ContactSolver, blockOnInclineSticks) {
  const ContactSolution solution = solved(onIncline(2, 4, 0.6));
  for (const double speed : solution.velocities) {
    EXPECT_NEAR(speed, 0, 1e-14);
  }
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_NEAR(solution.impulses[c][0], c < 2 ? 12 * 0.375 / 2 : 12 * 0.625 / 2, 1e-12);
  }
}

// μ = 0.25 < 0.5: slides with 2 − 0.25·4 = 1 m/s; N's centre moves by 0.5 μ = 0.125 m.
TEST(ContactSolver, blockOnInclineSlides) {
  const ContactSolution solution = solved(onIncline(2, 4, 0.25));
  EXPECT_NEAR(solution.velocities[0], 1, 1e-14);
  for (std::size_t k = 1; k < 6; ++k) {
    EXPECT_NEAR(solution.velocities[k], 0, 1e-14);
  }
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_NEAR(solution.impulses[c][0], c < 2 ? 12 * 0.4375 / 2 : 12 * 0.5625 / 2, 1e-12);
    EXPECT_NEAR(solution.impulses[c][1], -0.25 * solution.impulses[c][0], 1e-12);
  }
}

TEST(ContactSolver, withoutFrictionNothingSlows) {
  const ContactSolution solution = solved(onIncline(2, 4, 0));
  EXPECT_EQ(solution.velocities[0], 2);
  EXPECT_NEAR(solution.velocities[2], 0, 1e-14);
  for (const ContactProblem::Triple& impulse : solution.impulses) {
    EXPECT_NEAR(impulse[0], 3, 1e-13);
    EXPECT_EQ(impulse[1], 0);
    EXPECT_EQ(impulse[2], 0);
  }
}

TEST(ContactSolver, infiniteFrictionStops) {
  for (const double friction : {1e3, 1e12, 1e100}) {
    const ContactSolution solution = solved(onIncline(2, 4, friction));
    for (const double speed : solution.velocities) {
      EXPECT_NEAR(speed, 0, 1e-13) << friction;
    }
  }
  // Pushed 40 times harder it tips: no normal impulse uphill. All turns about the lower edge.
  const ContactSolution tipped = solved(onIncline(160, 4, 1e12));
  EXPECT_GT(tipped.velocities[4], 1);
  EXPECT_EQ(tipped.impulses[0][0], 0);
  EXPECT_EQ(tipped.impulses[1][0], 0);
}

// Each level carries what is above it, one quarter at each corner.
TEST(ContactSolver, stackSharesEvenly) {
  const ContactScene scene = cubeStack(10, 2, 0.5, 0.5);
  const ContactSolution solution = solved(scene);
  for (std::size_t c = 0; c < solution.impulses.size(); ++c) {
    const double above = 10.0 - static_cast<double>(c / 4);
    EXPECT_NEAR(solution.impulses[c][0], above * 2 * 0.5 / 4, 1e-12);
    EXPECT_NEAR(solution.impulses[c][1], 0, 1e-12);
    EXPECT_NEAR(solution.impulses[c][2], 0, 1e-12);
  }
}

TEST(ContactSolver, heavyRestsOnLight) {
  ContactScene scene;
  scene.add(1, {0.5, 0.5, 0.5}, {0, 0, 0.5}, {0, 0, -1});
  scene.add(1e6, {0.5, 0.5, 0.5}, {0, 0, 1.5}, {0, 0, -1});
  scene.touchFlat(0, kNobody, 0, 0, 0.5, 0.5, 0, 0.5);
  scene.touchFlat(1, 0, 0, 0, 0.5, 0.5, 1, 0.5);
  const ContactSolution solution = solved(scene);
  for (std::size_t c = 0; c < 8; ++c) {
    EXPECT_NEAR(solution.impulses[c][0], c < 4 ? (1e6 + 1) / 4 : 1e6 / 4, 2e-6);  // measured 6e-7
  }
}

// A million on nine: only together do forces that differ by a millionth leave none behind.
TEST(ContactSolver, heavyRestsOnAStack) {
  ContactScene scene = cubeStack(10, 1, 1, 0.5);
  for (std::size_t k = 0; k < 6; ++k) {
    scene.problem.inverseMass[54 + k] /= 1e6;
  }
  const ContactSolution solution = solved(scene);
  for (std::size_t c = 0; c < 40; ++c) {
    EXPECT_NEAR(solution.impulses[c][0], (1e6 + 9 - static_cast<double>(c / 4)) / 4, 1e-6) << c;
  }
  EXPECT_LE(solution.factorisations, 10);  // measured 4
}

// A light cube that rolls between two heavy ones, which pass each other: it is about to stand upright between
// them, and from an approach of 1e-8 m/s they are stopped within this very moment.
TEST(ContactSolver, jamTakesImpulsesMuchLargerThanWhatApproaches) {
  ContactScene scene;
  scene.add(2460, {0.2, 0.2, 0.2}, {-0.05, 0, -0.4}, {0, 0, 0});
  scene.add(1, {0.2, 0.2, 0.2}, {0, 0, 0}, {0, 0, 0});
  scene.add(2460, {0.2, 0.2, 0.2}, {0.05, 0, 0.4}, {-2.5, 0, -1e-8});
  scene.touch(1, 0, {-0.05, 0, -0.2}, 2, 1, 0.64);
  scene.touch(2, 1, {0.05, 0, 0.2}, 2, 1, 0.64);
  const ContactSolution solution = solved(scene);
  EXPECT_GT(solution.impulses[0][0], 600);
  EXPECT_GT(solution.impulses[1][0], 600);
  // A warm start as small as the approach does not hide them; measured 66 factorisations.
  ContactSolution warm;
  warm.impulses.assign(2, {1e-8, 0, 0});
  ContactSolver solver;
  EXPECT_TRUE(solver.solve(scene.problem, warm));
  EXPECT_NEAR(warm.impulses[1][0], solution.impulses[1][0], 1e-6);
  EXPECT_LE(warm.factorisations, 200);
}

// 44 bricks, 324 contacts of which the weights determine few; the floor carries the weight of all, and
// mirrored corners carry the same.
TEST(ContactSolver, wallOfBricksRests) {
  const ContactScene scene = brickWall(8, 6, 0.01, 0.6);
  const ContactSolution solution = solved(scene);
  double floor = 0;
  for (std::size_t c = 0; c < scene.problem.contacts.size(); ++c) {
    if (scene.problem.contacts[c].b == kNobody) {
      floor += solution.impulses[c][0];
    }
  }
  EXPECT_NEAR(floor, 48 * 0.01, 1e-12);
  for (std::size_t c = 0; c < scene.problem.contacts.size(); c += 2) {  // y and −y
    EXPECT_NEAR(solution.impulses[c][0], solution.impulses[c + 1][0], 1e-13);
  }
}

/// A ball-like body of 1 kg and 0.4 kg m² that strikes the floor 1 m below its centre.
ContactScene obliqueImpact(double along, double friction) {
  ContactScene scene;
  const double half = std::sqrt(0.6);  // m/3 (x² + y²) = 0.4
  scene.add(1, {half, half, half}, {0, 0, 1}, {along, 0, -1});
  scene.touch(0, kNobody, {0, 0, 0}, 2, 1, friction);
  return scene;
}

// Tangential effective mass 1/(1/m + r²/I) = 1/3.5. Sticks while |v_t|/3.5 ≤ μ.
TEST(ContactSolver, obliqueImpact) {
  const ContactSolution sticks = solved(obliqueImpact(1, 0.3));
  EXPECT_NEAR(sticks.velocities[0], 1 - 1 / 3.5, 1e-15);
  EXPECT_NEAR(sticks.velocities[0], sticks.velocities[4], 1e-15);  // rolls: v_x − ω_y r = 0
  const ContactSolution slips = solved(obliqueImpact(1, 0.25));
  EXPECT_NEAR(slips.velocities[0], 0.75, 1e-15);
  EXPECT_NEAR(slips.velocities[4], 0.25 / 0.4, 1e-15);
}

TEST(ContactSolver, whatPartsIsLeftAlone) {
  ContactScene scene = obliqueImpact(1, 0.3);
  scene.problem.free[2] = 1;
  const ContactSolution solution = solved(scene);
  EXPECT_EQ(solution.velocities, scene.problem.free);
  EXPECT_EQ(solution.factorisations, 0);
}

// No impulses leave a residual of 1e-10 V only, but are far from the answer.
TEST(ContactSolver, slowApproachBesideFastSlipIsNotOverlooked) {
  const ContactSolution solution = solved([] {
    ContactScene scene = obliqueImpact(1, 0.3);
    scene.problem.free[2] = -1e-10;
    return scene;
  }());
  EXPECT_NEAR(solution.velocities[2], 0, 1e-15);
  EXPECT_NEAR(solution.impulses[0][0], 1e-10, 1e-15);
}

TEST(ContactSolver, noContacts) {
  ContactScene scene;
  scene.add(1, {1, 1, 1}, {}, {1, 2, 3}, {4, 5, 6});
  EXPECT_EQ(solved(scene).velocities, scene.problem.free);
}

TEST(ContactSolver, targetsAreMet) {
  ContactScene scene = obliqueImpact(0, 0.3);
  scene.problem.contacts[0].target = {0.5, 0.25, 0};
  const ContactSolution solution = solved(scene);
  EXPECT_NEAR(solution.velocities[2], 0.5, 1e-15);
  EXPECT_NEAR(solution.velocities[0] - solution.velocities[4], 0.25, 1e-15);
}

/// A rod of Painlevé's, 2 m long, at 45°, pressed on the floor while its end slides.
ContactScene rod(double friction, double pressed) {
  ContactScene scene;
  scene.add(1, {1, 0.01, 0.01}, {-0.5, 0, 0.5}, {0, 0, -pressed});
  scene.touch(0, kNobody, {0, 0, 0}, 2, 1, friction);
  scene.problem.contacts[0].admissible = ContactProblem::Admissible::kLine;
  scene.problem.contacts[0].slip = {1, 0};
  return scene;
}

// With I = 1/3: n M⁻¹ (n − μ t) = 1 + 0.25/I − μ (0.25/I) = 1.75 − 0.75 μ, to 1e-4. Positive: λ = 1/that.
TEST(ContactSolver, contactThatSlides) {
  const ContactSolution solution = solved(rod(1, 1));
  EXPECT_NEAR(solution.impulses[0][0], 1, 1e-3);
  EXPECT_NEAR(solution.impulses[0][1], -solution.impulses[0][0], 1e-15);
}

// Negative: no λ ≥ 0 keeps the end from sinking (Painlevé's paradox). Lifted, there are two answers: none,
// and one.
TEST(ContactSolver, reportsThatThereIsNoSolution) {
  const ContactScene scene = rod(4, 1);
  ContactSolver solver;
  ContactSolution solution;
  EXPECT_FALSE(solver.solve(scene.problem, solution));
  EXPECT_FALSE(solution.solved);
  EXPECT_GT(solution.residual, 0.1 * solution.scale);
  expectHonest(scene.problem, solution);
  EXPECT_GE(solution.factorisations, ContactSolver::kMost);
  EXPECT_FALSE(solver.solve(scene.problem, solution, 100));
  EXPECT_LT(solution.factorisations, 250);
  EXPECT_EQ(solved(rod(4, -1)).impulses[0][0], 0);
}

TEST(ContactSolver, noNumberIsNoSolution) {
  const WithoutTraps withoutTraps;
  ContactScene scene = cubeStack(3, 1, 1, 0.5);
  scene.problem.free[8] = std::nan("");
  ContactSolver solver;
  ContactSolution solution;
  EXPECT_FALSE(solver.solve(scene.problem, solution));
}

TEST(ContactSolver, warmStartCostsNothing) {
  const ContactScene scene = cubeStack(10, 1, 0.5, 0.5);
  ContactSolver solver;
  ContactSolution solution;
  ASSERT_TRUE(solver.solve(scene.problem, solution));
  const ContactSolution cold = solution;
  ASSERT_TRUE(solver.solve(scene.problem, solution));
  EXPECT_LE(solution.factorisations, 1);
  for (std::size_t c = 0; c < cold.impulses.size(); ++c) {
    EXPECT_NEAR(solution.impulses[c][0], cold.impulses[c][0], 1e-13);
  }
}

// One object after another graph gives what a new one does.
TEST(ContactSolver, objectForgetsTheGraphBefore) {
  ContactSolver solver;
  for (const int n : {5, 2, 7, 7, 1}) {
    const ContactScene scene = cubeStack(n, 1, 0.5, 0.5);
    ContactSolution reused;
    ASSERT_TRUE(solver.solve(scene.problem, reused));
    const ContactSolution anew = solved(scene);
    EXPECT_EQ(reused.velocities, anew.velocities);
    EXPECT_EQ(reused.impulses, anew.impulses);
  }
}

// A cube at an edge, above and beside it: it enters if it moves down and towards it.
TEST(ContactSolver, aContactWithAChoiceTakesPartWhereAllOfItIsEntered) {
  const double diagonal = std::sqrt(0.5);
  for (const double sideways : {0.5, -0.5}) {
    ContactScene scene;
    const int cube = scene.add(1, {0.5, 0.5, 0.5}, {0, 0, 0.5}, {sideways, 0, -1});
    ContactProblem::Contact& contact = scene.touch(cube, kNobody, {0, 0, 0.5}, 2, 1, 0);
    // Rows along z, x, y: the directions are z and −x, the normal stays z.
    contact.directions = {{1, 0, 0}, {0, -1, 0}};
    ContactSolution solution;
    ASSERT_TRUE(ContactSolver().solve(scene.problem, solution));
    ASSERT_EQ(solution.impulses.size(), 1U);
    EXPECT_NEAR(solution.impulses[0][0], sideways > 0 ? 1 : 0, 1e-12);  // else it leaves along −x
    EXPECT_NEAR(solution.velocities[2], sideways > 0 ? 0 : -1, 1e-12);
    contact.directions = {{diagonal, diagonal, 0}};
    EXPECT_TRUE(ContactSolver().solve(scene.problem, solution));
    EXPECT_NEAR(solution.impulses[0][0], 1, 1e-12);
  }
}

}  // namespace
}  // namespace careen
