#include "physics/contact/group_loads.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/touching_bodies.h"

namespace careen {
namespace {

TEST(GroupLoads, areTheWeightsWhereNothingElseActs) {
  World world = cubeAbove(1);
  world.bodies[0].mass = solidBox(Vec3(0.1, 0.1, 0.1), 3);
  GroupOf of(world);
  GroupLoads loads(of.group);
  EXPECT_FALSE(loads.vary());
  loads.find(of.state);
  EXPECT_EQ(loads[0].force, Vec3(0, 0, -30));
  EXPECT_EQ(loads[0].torque, Vec3::Zero());
  EXPECT_NEAR(loads.acceleration(of.state), 10, 1e-15);
  EXPECT_EQ(loads.pull(of.state), 10);
}

// From 10 to 30 m/s² in 2 s: of each moment; accelerations count as the largest yet to come.
TEST(GroupLoads, areTheWeightsOfTheMomentWhereGravitySlopes) {
  World world = cubeAbove(1);
  world.gravityPath = GravityPath::kLinear;
  world.gravityChanges = {{.time = 2, .gravity = 3 * world.gravity}};
  GroupOf of(world);
  GroupLoads loads(of.group);
  EXPECT_TRUE(loads.vary());
  of.state[0].time = 0.5;
  loads.find(of.state);
  EXPECT_EQ(loads[0].force, Vec3(0, 0, -15));
  EXPECT_EQ(loads.acceleration(of.state), 30);
  EXPECT_EQ(loads.pull(of.state), 30);
  of.world.drag = Drag{.linear = 4, .angular = 0};
  of.state[0].velocity = Vec3(0, 0, 1);
  GroupLoads dragged(of.group);
  dragged.find(of.state);
  EXPECT_EQ(dragged[0].force, Vec3(0, 0, -19));
}

// F = −4 v and τ = −0.1 ω on 1 kg with I = 1/150 kg m²; corners are √0.03 m from the middle.
TEST(GroupLoads, ofDragFollowTheState) {
  World world = cubeAbove(1);
  world.drag = Drag{.linear = 4, .angular = 0.1};
  GroupOf of(world);
  of.state[0].velocity = Vec3(0, 0, -5);
  of.state[0].angularMomentum = Vec3(0, 2.0 / 150, 0);
  GroupLoads loads(of.group);
  EXPECT_TRUE(loads.vary());
  loads.find(of.state);
  EXPECT_LT((loads[0].force - Vec3(0, 0, 10)).norm(), 1e-14);
  EXPECT_LT((loads[0].torque - Vec3(0, -0.2, 0)).norm(), 1e-15);
  EXPECT_NEAR(loads.acceleration(of.state), 10 + 0.2 * 150 * std::sqrt(0.03), 1e-12);
  EXPECT_NEAR(loads.pull(of.state), 10 + 0.2 * 150 * std::sqrt(0.03), 1e-12);
  of.state[0] = {.position = Vec3(0, 0, 1)};
  EXPECT_NEAR(loads.acceleration(of.state), 10, 1e-14);
}

TEST(GroupLoads, ofWhatIsHeldAreNone) {
  World world = cubeAbove(1);
  world.bodies[0].mass = immovable();
  GroupOf of(world);
  GroupLoads loads(of.group);
  loads.find(of.state);
  EXPECT_EQ(loads[0].force, Vec3::Zero());
  EXPECT_EQ(loads.acceleration(of.state), 0);
}

}  // namespace
}  // namespace careen
