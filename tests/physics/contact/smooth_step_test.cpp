#include "physics/contact/smooth_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "physics/contact/island.h"
#include "support/touching_bodies.h"

namespace careen {
namespace {

constexpr double kWithin = 1e-6;  // [m] tolerance

struct Smooth {
  explicit Smooth(World of, const std::vector<ContactFeature>& features = {}, double tolerance = kWithin)
      : world(std::move(of)),
        system(world, touching(world), features),
        step(world, system, tolerance, timeScaleOf(world, tolerance)) {
    EXPECT_TRUE(system.findModes(step.state()));
    EXPECT_TRUE(step.begin());
  }
  World world;
  ContactSystem system;
  SmoothStep step;
};

Smooth sliding(double speed) {
  const World world = cubeAbove(0.1, Vec3(speed, 0, 0));
  return Smooth(world, lowerCorners(world, 0, 0.2));
}

// 2 m/s² back: x = 3 t − t².
TEST(SmoothStep, slidesByItsParabola) {
  Smooth slide = sliding(3);
  ASSERT_TRUE(slide.step.take(0.1));
  EXPECT_EQ(slide.step.length(), 0.1);
  EXPECT_NEAR(slide.step.state()[0], 0.29, 1e-14);
  EXPECT_NEAR(slide.step.state()[7], 2.8, 1e-14);
  EXPECT_LT(slide.step.error(), 1e-6);
  EXPECT_FALSE(slide.step.gainsEnergy());
  EXPECT_FALSE(slide.step.isMovedByCorrection());
  EXPECT_NEAR(positionAt(slide.step.motion(0), 0.05).x(), 0.1475, 1e-14);
  const SmoothStep::State within = slide.step.stateWithin(slide.step.motions(), 0.05);
  EXPECT_NEAR(within[0], 0.1475, 1e-14);
  EXPECT_NEAR(within[7], 2.9, 1e-13);
  slide.step.retake(0.05);
  EXPECT_NEAR(slide.step.state()[0], 0.1475, 1e-14);
  slide.step.retake(0);
  EXPECT_EQ(slide.step.state()[0], 0);
}

// Slip of 0.1 m/s ends after 0.05 s; past it the equations are others.
TEST(SmoothStep, endsBeforeSlipDoes) {
  Smooth slide = sliding(0.1);
  ASSERT_TRUE(slide.step.take(1));
  EXPECT_LT(slide.step.length(), 0.05);
  EXPECT_GT(slide.step.length(), 0.0499);
  EXPECT_GT(slide.step.state()[7], 0);
}

// 0.4 rad at 20 rad/s, about any axis of a cube; less where the tolerance asks for it.
TEST(SmoothStep, turnsByLittle) {
  World world = cubeAbove(5);
  world.bodies[0].initial.angularMomentum = Vec3(0, 0, 20.0 / 150);
  for (const double tolerance : {1e-3, 1e-6}) {
    Smooth turning(world, {}, tolerance);
    ASSERT_TRUE(turning.step.take(1));
    const double length = turning.step.length();
    EXPECT_NEAR(length, 0.02, tolerance > 1e-4 ? 1e-15 : 0.01);
    EXPECT_LT(length, 0.02 + 1e-15);
    const SmoothStep::State& end = turning.step.state();
    EXPECT_NEAR(2 * std::atan2(end[6], end[3]), 20 * length, tolerance);
  }
}

// The next step starts with the last one's forces unless they are forgotten: with the same bits.
TEST(SmoothStep, goesOnFromItsEnd) {
  Smooth known = sliding(3);
  Smooth anew = sliding(3);
  for (Smooth* const each : {&known, &anew}) {
    ASSERT_TRUE(each->step.take(0.1));
    EXPECT_TRUE(each->step.goesOn());
  }
  anew.step.forgetForces();
  EXPECT_FALSE(anew.step.goesOn());
  for (Smooth* const each : {&known, &anew}) {
    ASSERT_TRUE(each->step.begin());
    ASSERT_TRUE(each->step.take(0.1));
    EXPECT_NEAR(each->step.state()[0], 0.6 - 0.04, 1e-14);
  }
}

// √(1 µm / 10 m/s²)/16.
TEST(SmoothStep, shortestIsAPartOfTheTimeScale) {
  EXPECT_NEAR(sliding(3).step.shortest(), std::sqrt(1e-7) / 16, 1e-15);
}

}  // namespace
}  // namespace careen
