#include "physics/contact/event_locator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "physics/contact/island.h"
#include "support/touching_bodies.h"

namespace careen {
namespace {

constexpr double kAccuracy = 1e-6;  // [m] tolerance

// A smooth step of bodies in their modes, at most so long.
struct Taken {
  Taken(World of, const std::vector<ContactFeature>& features, double most)
      : world(std::move(of)),
        system(world, touching(world), features),
        step(world, system, kAccuracy, timeScaleOf(world, kAccuracy)),
        events(system),
        locator(system, step, events, kAccuracy) {
    EXPECT_TRUE(system.findModes(step.state()));
    events.list();
    EXPECT_TRUE(step.begin());
    events.noteStart();
    EXPECT_TRUE(step.take(most));
  }
  World world;
  ContactSystem system;
  SmoothStep step;
  EventFunctions events;
  EventLocator locator;
};

// From 0.05 m above the floor at 1 m/s: 0.05 = t + 5 t².
TEST(EventLocator, aFallingCornerMeetsTheFloorAtItsRoot) {
  Taken fall(cubeAbove(0.15, Vec3(0, 0, -1)), {}, 0.2);
  ASSERT_GT(fall.step.length(), 0.05);
  EXPECT_TRUE(fall.locator.locate());
  EXPECT_NEAR(fall.step.length(), (std::sqrt(2) - 1) / 10, 1e-13);
  EXPECT_LE(fall.step.state()[2], 0.1);  // where the event function is negative
  EXPECT_NEAR(fall.step.state()[2], 0.1, 1e-13);
}

TEST(EventLocator, aStepInWhichNothingHappensStaysAsItIs) {
  Taken fall(cubeAbove(0.15, Vec3(0, 0, -1)), {}, 0.04);
  EXPECT_FALSE(fall.locator.locate());
  EXPECT_EQ(fall.step.length(), 0.04);
  EXPECT_FALSE(fall.locator.dips());
}

// Thrown up at 1 m/s from 0.01 m below a ceiling it comes back after 0.2 s: the corners' gaps are positive at
// both ends of the step, and negative most of the time between.
TEST(EventLocator, aPenetrationThatIsGoneAtTheEndIsFound) {
  World world = cubeAbove(1, Vec3(0, 0, 1));
  world.walls = {wall("ceiling", Vec3(0, 0, -1), -1.11)};
  Taken thrown(world, {}, 0.19);
  ASSERT_EQ(thrown.step.length(), 0.19);
  EXPECT_TRUE(thrown.locator.locate());
  EXPECT_NEAR(thrown.step.length(), 0.1 * (1 - std::sqrt(0.8)), 1e-13);  // 0.01 = t − 5 t²
}

// It slides off a table: its first corners are at the end after 0.02 s, both at once.
TEST(EventLocator, aContactLeavesItsFaceAtItsEnd) {
  World world;
  world.gravity = Vec3(0, 0, -10);
  world.bodies.push_back(box("slider", Vec3(0.1, 0.1, 0.1), 1, Vec3(0.28, 0, 0.2), Vec3(1, 0, 0)));
  world.bodies.push_back(box("table", Vec3(0.4, 0.4, 0.1), 1, Vec3(0, 0, 0)));
  world.bodies[1].mass = immovable();
  std::vector<ContactFeature> features;
  for (const ContactFeature& corner : lowerCorners(world)) {
    features.push_back(
        {.kind = ContactFeature::Kind::kPointOnFace, .a = 0, .b = 1, .onA = corner.onA, .axisB = 2});
  }
  Taken slide(world, features, 0.09);
  EXPECT_TRUE(slide.locator.locate());
  EXPECT_NEAR(slide.step.length(), 0.02, 1e-10);
  EXPECT_NEAR(slide.step.state()[2], 0.2, 1e-15);
}

}  // namespace
}  // namespace careen
