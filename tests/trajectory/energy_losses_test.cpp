#include "trajectory/energy_losses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/jointed.h"

namespace careen {
namespace {

// v = v₀ exp(−c t/m), and the same of ω with a cube's I = 2/3 · ¼ m: ½ m v₀² and ½ I ω₀² are lost but for
// their squares.
TEST(LossesOfRun, ofDrag) {
  World world;
  world.bodies = {box("die", Vec3::Constant(0.5), 2, Vec3::Zero(), Vec3(3, 0, 0), Vec3(0, 0, 4))};
  world.drag = Drag{.linear = 1, .angular = 0.25};
  const Trajectory run = record(world, {.duration = 2, .tolerance = 1e-9}, "");
  LossesOfRun losses(run);
  for (const double time : {0.3, 1.0, 1.7, 2.0}) {
    const double moving = 9 * (1 - std::exp(-2 * 1.0 / 2 * time));
    const double turning = 8.0 / 3 * (1 - std::exp(-2 * 0.25 * 3 * time));
    EXPECT_NEAR(losses.until(time).drag, moving + turning, 1e-7);
  }
}

// A slide of 1 kg stops against 2 N: 3 m/s last for 1.5 s and 2.25 m. After that nothing is lost.
TEST(LossesOfRun, ofDryFriction) {
  World world;
  world.bodies = {box("slide", Vec3::Constant(0.1), 1, Vec3::Zero(), Vec3(3, 0, 0))};
  test::join(world, Joint::Kind::kSlider, 0, {}, Vec3::Zero(), Vec3::UnitX()).grip = 2;
  const Trajectory run = record(world, {.duration = 2}, "");
  LossesOfRun losses(run);
  EXPECT_NEAR(losses.until(1).jointFriction, 4, 1e-6);  // of 2 m
  EXPECT_NEAR(losses.until(1.75).jointFriction, 4.5, 1e-6);
  EXPECT_NEAR(losses.until(2).jointFriction, 4.5, 1e-6);
  EXPECT_EQ(losses.until(2).sum(), losses.until(2).jointFriction);
}

// A slide of 1 kg at 3 m/s runs into its limit with e = 0.5, which takes ¾ of ½ m v²; and what lets go damps
// no more.
TEST(LossesOfRun, ofLimitsAndWhatLetsGo) {
  World world;
  world.bodies = {box("slide", Vec3::Constant(0.1), 1, Vec3::Zero(), Vec3(3, 0, 0))};
  Joint& rail = test::join(world, Joint::Kind::kSlider, 0, {}, Vec3::Zero(), Vec3::UnitX());
  rail.highest = 1.5;
  rail.restitution = 0.5;
  const Trajectory run = record(world, {.duration = 1}, "");
  ASSERT_EQ(run.jointImpulses.size(), 1U);
  LossesOfRun losses(run);
  EXPECT_EQ(losses.until(0.49).impacts, 0);
  EXPECT_NEAR(losses.until(0.51).impacts, 0.75 * 4.5, 1e-5);

  rail.highest = Joint::kFree;
  rail.damping = 1;
  rail.until = 0.5;
  const Trajectory freed = record(world, {.duration = 1, .tolerance = 1e-9}, "");
  EXPECT_NEAR(LossesOfRun(freed).until(1).damping, 4.5 * (1 - std::exp(-1)), 1e-7);
}

// The rule by itself: of any speed that is a polynomial of degree 4. x = s⁵ over 2 s: v = 5/2 s⁴, and
// c ∫ v² dt = 2 · 25/4 · 1/9.
TEST(LossesOfRun, areExactInAStepOfContact) {
  Trajectory run;
  run.settings.duration = 2;
  run.world.bodies = {box("bob", Vec3::Constant(0.1), 1, Vec3::Zero())};
  run.world.drag = Drag{.linear = 1, .angular = 0};
  ContactStep step{.duration = 2};
  step.position.fill(Vec3::Zero());
  step.worldFromBody.fill(Vec4::Zero());
  step.position[5] = Vec3(1, 0, 0);
  step.worldFromBody[0] = Vec4(0, 0, 0, 1);
  run.tracks = {{.segments = {{.start = 0, .motion = step}}}};
  EXPECT_NEAR(LossesOfRun(run).until(2).drag, 25.0 / 18, 1e-15);
  LossesOfRun inParts(run);
  inParts.until(0.7);
  EXPECT_NEAR(inParts.until(2).drag, 25.0 / 18, 1e-15);
}

}  // namespace
}  // namespace careen
