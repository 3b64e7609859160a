#include "physics/pile/crowd_direct.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/crates.h"
#include "support/crowd_stages.h"

namespace careen {
namespace {

using namespace test;

// Crates at rest on the floor, in a row that does not touch.
World cratesOnFloor(int count) {
  World world = floorWorld({.restitution = 0, .friction = 0.5});
  for (int k = 0; k < count; ++k) {
    world.bodies.push_back(
        crate("crate" + std::to_string(100 + k), Vec3::Constant(0.25), Vec3(k, 0, 0.25), {.friction = 0.5}));
  }
  return world;
}

// Their rows, as gravity pulls them for a step, with that impulse [N s] at each point as a first guess.
void load(CrowdStages& stages, PileSolver& solver, double guess = 0) {
  stages.meet(test::kCrowdStep);
  solver.begin(stages.members.size());
  for (int i = 0; i < static_cast<int>(stages.members.size()); ++i) {
    solver.setBody(i, stages.members[i], 0);
    solver.velocity(i) = stages.members[i].still() ? Vec3(Vec3::Zero())
                                                   : Vec3(test::kCrowdStep * stages.members.world.gravity);
  }
  for (const int slot : stages.contacts.near()) {
    for (PilePoint& point : stages.contacts[slot].points) {
      point.row = 0;
      point.normalImpulse = guess;
    }
    stages.contacts.addPresentRows(stages.contacts[slot], solver);
  }
  solver.link();
  solver.warmStart();
}

// The impulses of the four corners carry what gravity gave, m g h, wherever they start from.
TEST(CrowdDirect, floorCarriesTheWeight) {
  const World world = cratesOnFloor(1);
  const double weight = 125 * kGravity * test::kCrowdStep;
  for (const double guess : {0.0, 0.2 * weight}) {
    CrowdStages stages(world);
    PileSolver solver;
    load(stages, solver, guess);
    ASSERT_EQ(solver.rowCount(), 4U);
    CrowdDirect direct(stages.members, stages.contacts, stages.articulations, stages.memory);
    ASSERT_TRUE(direct.solve(solver));
    double sum = 0;
    for (int row = 0; row < 4; ++row) {
      sum += solver.normalImpulse(row);
    }
    // Its residual moves nothing by more than 2⁻¹⁰ of the tolerance in the step.
    const double residual = 0x1p-10 * CrowdMembers::kUsualTolerance / test::kCrowdStep;
    EXPECT_LT(solver.velocity(static_cast<int>(stages.of(0))).norm(), residual);
    EXPECT_NEAR(sum, weight, 125 * residual);
  }
}

TEST(CrowdDirect, hasNothingToSolveWithoutRows) {
  const World world = cratesOnFloor(0);
  CrowdStages stages(world);
  PileSolver solver;
  load(stages, solver);
  EXPECT_FALSE(
      CrowdDirect(stages.members, stages.contacts, stages.articulations, stages.memory).solve(solver));
}

// More than a few rows are not tried while a wait lasts; what is solved ends it.
TEST(CrowdDirect, waitsAfterAFailureWhereThereAreManyRows) {
  const World world = cratesOnFloor(40);
  CrowdStages stages(world);
  PileSolver solver;
  load(stages, solver);
  ASSERT_GT(solver.rowCount(), CrowdDirect::kFewRows);
  CrowdDirect direct(stages.members, stages.contacts, stages.articulations, stages.memory);
  stages.memory.directWait = 1;
  stages.memory.directPause = 8;
  EXPECT_FALSE(direct.solve(solver));
  EXPECT_EQ(stages.memory.directWait, 0);
  EXPECT_EQ(stages.memory.directPause, 8);
  EXPECT_TRUE(direct.solve(solver));
  EXPECT_EQ(stages.memory.directPause, 1);
}

}  // namespace
}  // namespace careen
