#include "physics/contact/stillness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/touching_bodies.h"

namespace careen {
namespace {

// A cube on the floor with these modes at all its corners.
struct OnFloor {
  OnFloor(const Vec3& velocity, ContactForces::Mode mode, double friction = 0.5, double height = 0.1)
      : world(cubeAbove(height, velocity)), system(world, touching(world), lowerCorners(world, 0, friction)) {
    system.modes().assign(4, mode);
    y = system.pack();
    std::vector<double> rate;
    EXPECT_TRUE(system.rate(y, rate));
  }
  World world;
  ContactSystem system;
  std::vector<double> y;
};

using Mode = ContactForces::Mode;

TEST(Stillness, isRestIfForcesCarryTheWeight) {
  EXPECT_TRUE(isAtRest(OnFloor(Vec3::Zero(), Mode::kStick).system));
  EXPECT_FALSE(isAtRest(OnFloor(Vec3(1e-9, 0, 0), Mode::kOn).system));
  EXPECT_FALSE(isAtRest(OnFloor(Vec3::Zero(), Mode::kOff).system));  // it begins to fall
}

// A quarter of the tolerance in √(r/g), r = √0.03 m.
TEST(Stillness, slipCreepsIfItHardlyGetsAnywhere) {
  const double limit = 0.25 * 1e-6 * std::sqrt(10 / std::sqrt(0.03));
  EXPECT_TRUE(creeps(OnFloor(Vec3(0.99 * limit, 0, 0), Mode::kOn).system, 0, 1e-6));
  EXPECT_FALSE(creeps(OnFloor(Vec3(1.01 * limit, 0, 0), Mode::kOn).system, 0, 1e-6));
  EXPECT_FALSE(creeps(OnFloor(Vec3(0.99 * limit, 0, 0), Mode::kOn, 0).system, 0, 1e-6));
}

// Friction slows it by 5 m/s²: it counts as stopped from 4 tolerances in √(r/5) on.
TEST(Stillness, slipIsStoppedWhenItHasNearlyEnded) {
  const double limit = 4 * 1e-6 * std::sqrt(5 / std::sqrt(0.03));
  OnFloor slow(Vec3(0.99 * limit, 0, 0), Mode::kSlip);
  EXPECT_TRUE(stopSlip(slow.system, slow.y, 1e-6));
  EXPECT_NEAR(slow.y[7], 0, 1e-18);
  EXPECT_EQ(slow.system.modes()[0], Mode::kSlip);  // modes are found anew from there
  OnFloor fast(Vec3(1.01 * limit, 0, 0), Mode::kSlip);
  EXPECT_FALSE(stopSlip(fast.system, fast.y, 1e-6));
  EXPECT_EQ(fast.y[7], 1.01 * limit);
}

}  // namespace
}  // namespace careen
