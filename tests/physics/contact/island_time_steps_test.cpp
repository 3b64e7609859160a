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

// One that slides: what its contacts cost in a step, and the looking for them.
TEST(IslandTimeSteps, workIsThatOfTheLastOne) {
  const World world = cubeAbove(0.1, Vec3(1, 0, 0), 0.5);
  const std::vector<TouchingBody> bodies = touching(world);
  IslandTimeSteps steps(world, bodies, 1e-6, 8);
  for (int k = 0; k < 2; ++k) {
    const double before = steps.stepper().equations().work();
    steps.take(1e-3, kForever);
    const double spent = steps.stepper().equations().work() - before;
    EXPECT_TRUE(k > 0 || spent > 0);
    EXPECT_EQ(steps.work(), spent + IslandTimeSteps::kWorkOfGeometry);
  }
}

TEST(IslandTimeSteps, areCutWithTheirStepper) {
  const World world = cubeAbove(5);
  const std::vector<TouchingBody> bodies = touching(world);
  IslandTimeSteps steps(world, bodies, 1e-6, 8);
  steps.take(1e-3, kForever);
  const double length = 0.5 * steps.stepper().length();
  steps.cutTo(length);
  EXPECT_EQ(steps.stepper().length(), length);
  EXPECT_NEAR(steps.stepper().state()[0].position.z(), 5 - 5 * length * length, 1e-15);
}

}  // namespace
}  // namespace careen
