#include "physics/pile/crowd_loads.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "support/crates.h"
#include "support/crowd_stages.h"

namespace careen {
namespace {

using namespace test;

constexpr double kStiffness = 2000;  // [N/m]

// A crate of 125 kg, pulled 0.5 m aside from where its spring hangs.
World pulledCrate() {
  World world;
  world.bodies.push_back(crate("a", Vec3::Constant(0.25), Vec3(0.5, 0, 0), {}));
  world.springs.push_back({.from = {.body = 0}, .to = {.body = {}}, .stiffness = kStiffness});
  return world;
}

TEST(CrowdLoads, withoutSpringsAndDragAreGravity) {
  World world = floorWorld({});
  world.bodies.push_back(crate("a", Vec3::Constant(0.25), Vec3(0, 0, 1), {}));
  CrowdStages stages(world);
  stages.loads.find();
  EXPECT_FALSE(stages.loads.any());
  EXPECT_EQ(stages.loads.acceleration(0), world.gravity);
  EXPECT_EQ(stages.loads.torque(0), Vec3(0, 0, 0));
}

// From gravity to three times as much in 1 s: a step's is that of its middle, and so is that of the one
// before.
TEST(CrowdLoads, takeGravityOfTheMiddleOfTheStepWhereItSlopes) {
  World world = floorWorld({});
  world.gravityPath = GravityPath::kLinear;
  world.gravityChanges = {{.time = 1, .gravity = 3 * world.gravity}};
  world.bodies.push_back(crate("a", Vec3::Constant(0.25), Vec3(0, 0, 1), {}));
  CrowdStages stages(world);
  stages.members.time = 0.5;
  stages.members.h = 0.25;
  stages.memory.length = 0.5;
  stages.loads.find();
  EXPECT_LT((stages.loads.acceleration(1) - 2.25 * world.gravity).norm(), 1e-14);
  EXPECT_LT((stages.loads.accelerationBefore(1) - 1.5 * world.gravity).norm(), 1e-14);
}

// Implicit midpoint from rest: x' = x + h²/4 a, a = −k/m x', so a = −k/m x / (1 + k h²/4m).
TEST(CrowdLoads, springPullsAsInTheMiddleOfTheStep) {
  const World world = pulledCrate();
  CrowdStages stages(world);
  const double h = 0.02;
  stages.members.h = h;
  stages.loads.find();
  const double stiff = kStiffness / 125;
  const double expected = -stiff * 0.5 / (1 + 0.25 * stiff * h * h);
  // What four iterations leave is the fourth power of k h²/4m, 1.6e-3.
  EXPECT_NEAR(stages.loads.acceleration(0).x(), expected, 1e-10 * std::abs(expected));
}

// An eighth of a radian per step.
TEST(CrowdLoads, springLimitsTheStep) {
  const World world = pulledCrate();
  const CrowdStages stages(world);
  EXPECT_NEAR(stages.loads.longestStep(), 0.125 / std::sqrt(kStiffness / 125), 1e-15);
}

// What was pushed has the velocity of mid-step: half a step of force is missing.
TEST(CrowdLoads, halfKickIsThatOfTheTimeBehind) {
  World world = floorWorld({});
  world.bodies.push_back(crate("a", Vec3::Constant(0.25), Vec3(0, 0, 1), {}));
  CrowdStages stages(world);  // the floor has place 0
  stages.members[1].behind = 0.01;
  EXPECT_EQ(stages.loads.halfKick(1), 0.01 * world.gravity);
}

// Of a wheel with I = 0.1 kg m² whose corners are 0.3 m from its axis, at 20 N m: a = 60 m/s² moves them by
// two tolerances in √(4 t/a). A spring of k = 90 N m/rad in its hinge: an eighth of a radian of √(k/I) = 30
// rad/s.
TEST(CrowdLoads, jointsShortenTheStep) {
  World world;
  world.bodies.push_back(crate("wheel", Vec3(0.2, 0.2, 0.1), Vec3::Zero(), {}));
  world.bodies[0].mass.inverseInertiaBody = Vec3::Constant(10);
  Joint hinge;
  hinge.kind = Joint::Kind::kHinge;
  hinge.from.body = 0;
  world.joints = {hinge};
  EXPECT_EQ(CrowdStages(world).loads.longestStep(), std::numeric_limits<double>::infinity());
  world.joints[0].effort = -20;
  EXPECT_NEAR(CrowdStages(world).loads.longestStep(), std::sqrt(4 * CrowdMembers::kUsualTolerance / 60),
              1e-12);
  world.joints[0].effort = 0;
  world.joints[0].stiffness = 90;
  EXPECT_NEAR(CrowdStages(world).loads.longestStep(), 0.125 / 30, 1e-12);
}

}  // namespace
}  // namespace careen
