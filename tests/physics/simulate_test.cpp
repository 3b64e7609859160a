#include "physics/simulate.h"

#include <algorithm>
#include <cmath>
#include <vector>

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

// Told in order, up to the end; and told or not, the run is the same.
TEST(Simulate, tellsHowFarItIs) {
  class HowFar : public Memory {
   public:
    void reaches(double time) override { times.push_back(time); }
    std::vector<double> times;
  };
  constexpr double kDuration = 2;
  for (const Method method : {Method::kExact, Method::kListing1, Method::kRungeKutta4}) {
    World world = sampleRoom(makeBox({.velocity = {30, 5, 0}, .restitution = 1}));
    for (Wall& wall : world.walls) {
      wall.material.restitution = 1;
    }
    world.bodies.push_back(world.bodies.front());
    world.bodies.back().name = "other";
    world.bodies.back().initial.pose.position += Vec3(0, 0, 1);
    const RunSettings settings{.method = method, .duration = kDuration, .dt = 0.01};
    HowFar recorder;
    simulate(world, settings, recorder);
    ASSERT_FALSE(recorder.times.empty());
    EXPECT_TRUE(std::is_sorted(recorder.times.begin(), recorder.times.end()));
    EXPECT_GE(recorder.times.front(), 0);
    EXPECT_LE(recorder.times.back(), kDuration);
    EXPECT_GT(recorder.times.back(), 0.4 * kDuration);

    RunProgress last;
    Memory told;
    simulate(world, settings, told, {}, [&last](const RunProgress& now) { last = now; });
    EXPECT_TRUE(last.isOver);
    EXPECT_EQ(last.now.records, told.moved.size() + told.impacts.size());
    ASSERT_EQ(told.moved.size(), recorder.moved.size());
    const auto endOf = [&world](const Memory& run) {
      return stateAt(run.moved.back().motion, world.bodies.front().mass, 0).pose.position;
    };
    EXPECT_EQ(told.moved.back().time, recorder.moved.back().time);
    EXPECT_EQ(endOf(told), endOf(recorder));
  }
}

}  // namespace
}  // namespace careen
