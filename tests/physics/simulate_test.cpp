#include "physics/simulate.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "physics/world/method.h"
#include "support/physics_worlds.h"

namespace careen {
namespace {

TEST(Simulate, refusesTimesThatAreNone) {
  const World world = sampleRoom(makeBox({}));
  Memory memory;
  for (const double bad : {-1.0, HUGE_VAL, std::nan("")}) {
    EXPECT_THROW(simulate(world, {.method = Method::kListing1, .duration = bad}, memory), InputError) << bad;
    EXPECT_THROW(simulate(world, {.method = Method::kListing1, .duration = 1, .dt = bad}, memory), InputError)
        << bad;
  }
  EXPECT_THROW(simulate(world, {.method = Method::kListing1, .duration = 1, .dt = 0}, memory), InputError);
  EXPECT_TRUE(memory.moved.empty());
}

TEST(Simulate, movesTheWorldByTheMethodAskedFor) {
  const World world = sampleRoom(makeBox({.velocity = {1, 0, 0}}));
  Memory memory;
  simulate(world, {.method = Method::kListing1, .duration = 1, .dt = 0.125}, memory);
  EXPECT_EQ(memory.last().pose.position, Vec3(1, 0, 0));
}

}  // namespace
}  // namespace careen
