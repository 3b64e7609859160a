#include "physics/contact/island_time_steps.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/touching_bodies.h"

namespace careen {
namespace {

constexpr double kForever = 1e300;

TEST(IslandTimeSteps, areAFewAtLeast) {
  const World world = cubeAbove(0.1, Vec3(1, 0, 0));
  const std::vector<TouchingBody> bodies = touching(world);
  IslandTimeSteps steps(world, bodies, 1e-6, 0);
  EXPECT_EQ(steps.left(), 8);
  for (int k = 1; k <= 8; ++k) {
    EXPECT_EQ(steps.take(1e-3, kForever), k < 8);
  }
  EXPECT_EQ(steps.left(), 0);
}

// Whether it rests is asked after 16 of them; all its contacts are its own then.
TEST(IslandTimeSteps, endWhenHardlyAnythingMoves) {
  const World world = cubeAbove(0.1);
  const std::vector<TouchingBody> bodies = touching(world);
  IslandTimeSteps steps(world, bodies, 1e-6, 100);
  int taken = 1;
  while (steps.take(1e-3, kForever)) {
    ++taken;
  }
  EXPECT_EQ(taken, 16);
  EXPECT_EQ(steps.contacts().size(), 4U);
}

// What flies has no contacts to solve: its work is that of looking for them.
TEST(IslandTimeSteps, workIsThatOfTheLastOne) {
  const World world = cubeAbove(5);
  const std::vector<TouchingBody> bodies = touching(world);
  IslandTimeSteps steps(world, bodies, 1e-6, 8);
  for (int k = 0; k < 2; ++k) {
    steps.take(1e-3, kForever);
    EXPECT_EQ(steps.work(), IslandTimeSteps::kWorkOfGeometry);
  }
  EXPECT_TRUE(steps.contacts().empty());
  const double before = steps.stepper().state()[0].position.z();
  steps.cutTo(0.5 * steps.stepper().length());
  EXPECT_GT(steps.stepper().state()[0].position.z(), before);
}

}  // namespace
}  // namespace careen
