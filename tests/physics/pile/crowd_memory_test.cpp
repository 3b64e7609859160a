// What a step remembers for the next is all in one place, and can be set.
#include "physics/pile/crowd_memory.h"

#include <gtest/gtest.h>

#include <cmath>

#include "physics/pile/crowd.h"
#include "support/crates.h"

namespace careen {
namespace {

using namespace test;

// Corners may leave their tangents by r ω² h²/2 = bent × tolerance.
TEST(CrowdMemory, bendsAllowedGiveTheNextLength) {
  World world;
  Body body = crate("a", Vec3::Constant(0.25), Vec3(0, 0, 0), {});
  const double spin = 20;
  body.initial.angularMomentum = body.mass.inertiaBody.z() * Vec3(0, 0, spin);
  world.bodies.push_back(body);
  Crowd crowd(world, Crowd::kUsualTolerance);
  crowd.admit(0, body.initial, Quat::Identity());
  for (const double bent : {2.0, CrowdMemory::kMostBent}) {
    crowd.memory().bent = bent;
    const double radius = 0.25 * std::sqrt(3.0);
    EXPECT_NEAR(crowd.nextLength(1), std::sqrt(2 * bent * Crowd::kUsualTolerance / radius) / spin, 1e-12);
  }
}

// Sweeps of a jam that is over: half as many from step to step.
TEST(CrowdMemory, effortOfAJamFades) {
  World world = floorWorld({});
  world.bodies.push_back(crate("a", Vec3::Constant(0.25), Vec3(0, 0, 3), {}));
  Crowd crowd(world, Crowd::kUsualTolerance);
  crowd.admit(0, world.bodies[0].initial, Quat::Identity());
  crowd.memory().effort = 8;
  for (const int effort : {4, 2, 1, 1}) {
    const double before = crowd.length();
    crowd.step(1);
    EXPECT_EQ(crowd.memory().effort, effort);
    EXPECT_EQ(crowd.memory().length, before);
  }
}

// A place begins with what it comes with: its rates, and how long its last step was.
TEST(CrowdMemory, newMembersHaveTheirOwnPast) {
  World world;
  world.bodies.push_back(crate("a", Vec3::Constant(0.25), Vec3(0, 0, 0), {}));
  world.bodies[0].initial.velocity = Vec3(1, 0, 0);
  Crowd crowd(world, Crowd::kUsualTolerance);
  const std::size_t place = crowd.admit(0, world.bodies[0].initial, Quat::Identity(), 0.125);
  EXPECT_EQ(crowd.memory().places[place].past, 0.125);
  EXPECT_EQ(crowd.memory().places[place].rates.velocity, Vec3(1, 0, 0));
}

}  // namespace
}  // namespace careen
