#include "physics/world/forces.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/article_equations.h"
#include "support/physics_worlds.h"

namespace careen {
namespace {

std::vector<BodyState> statesOf(const World& world) {
  std::vector<BodyState> states;
  for (const Body& body : world.bodies) {
    states.push_back(body.initial);
  }
  return states;
}

std::vector<Load> loadsOf(const World& world) {
  std::vector<Load> loads;
  computeLoads(world, world.gravity, statesOf(world), loads);
  return loads;
}

Body heavyBox(const std::string& name, const Vec3& position) {
  return makeBox({.halfExtents = {0.1, 0.2, 0.3}, .position = position, .density = 100, .name = name});
}

TEST(Gravity, pullsEachBodyByItsWeight) {
  World world;
  world.gravity = {0, 0, -10};
  world.bodies = {makeBox({.halfExtents = {1, 1, 1}, .density = 2}),
                  makeBox({.halfExtents = {0.5, 0.5, 0.5}})};
  const std::vector<Load> loads = loadsOf(world);
  EXPECT_EQ(loads[0].force, Vec3(0, 0, -160));
  EXPECT_EQ(loads[1].force, Vec3(0, 0, -4));
  EXPECT_EQ(loads[0].torque, Vec3::Zero());
}

TEST(Gravity, leavesAHeldBodyAlone) {
  World world;
  world.gravity = {0, 0, -10};
  world.bodies = {makeBox({})};
  world.bodies[0].mass = immovable();
  EXPECT_EQ(loadsOf(world)[0].force, Vec3::Zero());
}

TEST(DragLoad, pointsAgainstTheMotion) {
  const Load load = dragLoad({.linear = 2, .angular = 3}, {1, -2, 0.5}, {4, 0, -1});
  EXPECT_EQ(load.force, Vec3(-2, 4, -1));
  EXPECT_EQ(load.torque, Vec3(-12, 0, 3));
}

TEST(DragLoad, actsOnEveryBodyOfTheWorld) {
  World world;
  world.drag = Drag{.linear = 0.5, .angular = 0.25};
  world.bodies = {makeBox({.velocity = {2, 0, 0}, .angularVelocity = {0, 4, 0}})};
  const Load load = loadsOf(world)[0];
  EXPECT_EQ(load.force, Vec3(-1, 0, 0));
  EXPECT_LT((load.torque - Vec3(0, -1, 0)).norm(), 1e-15);  // measured 0
}

// k = 2 N/m, 5 m long, 1 m at rest: 8 N towards the anchor; at the arm (0, 0.2, 0) that turns about −z.
TEST(Springs, pullACornerTowardsTheWorldByHand) {
  World world;
  world.bodies = {heavyBox("a", {0, 0, 0})};
  world.springs = {{.from = {.body = 0, .point = {0, 0.2, 0}},
                    .to = {.body = {}, .point = {5, 0.2, 0}},
                    .stiffness = 2,
                    .restLength = 1}};
  const Load load = loadsOf(world)[0];
  EXPECT_EQ(load.force, Vec3(8, 0, 0));
  EXPECT_LT((load.torque - Vec3(0, 0, -1.6)).norm(), 1e-15);  // measured 0
  EXPECT_EQ(springEnergy(world, statesOf(world)), 0.5 * 2 * 4 * 4);
}

TEST(Springs, pushWhenShorterThanAtRest) {
  World world;
  world.bodies = {heavyBox("a", {0, 0, 0})};
  world.springs = {
      {.from = {.body = {}, .point = {1, 0, 0}}, .to = {.body = 0}, .stiffness = 4, .restLength = 3}};
  EXPECT_EQ(loadsOf(world)[0].force, Vec3(-8, 0, 0));
}

TEST(Springs, pullTwoBodiesAlikeAndTurnNothingAsAWhole) {
  World world;
  world.bodies = {heavyBox("a", {0, 0, 0}), heavyBox("b", {1, 2, 0.5})};
  world.bodies[0].initial.pose.worldFromBody = axisAngle(Vec3(2, -1, 2) / 3, 0.7);
  world.bodies[0].initial.velocity = {1, 2, 3};
  world.bodies[1].initial.angularMomentum = {3, 1, -2};
  world.springs = {{.from = {.body = 0, .point = {0.1, 0.2, 0.3}},
                    .to = {.body = 1, .point = {-0.1, 0.2, -0.3}},
                    .stiffness = 30,
                    .damping = 2,
                    .restLength = 0.5}};
  const std::vector<Load> loads = loadsOf(world);
  EXPECT_GT(loads[0].force.norm(), 10) << "measured 66";
  EXPECT_EQ(loads[0].force, Vec3(-loads[1].force));
  const Vec3 about0 = loads[0].torque + loads[1].torque + Vec3(1, 2, 0.5).cross(loads[1].force);
  EXPECT_LT(about0.norm(), 4e-14);  // measured 7.9e-15
}

TEST(Springs, listedInAnyOrderPullAlikeToTheBit) {
  World world;
  world.gravity = {0, 0, -9.81};
  world.bodies = {makeBox({.halfExtents = {0.1, 0.2, 0.3}})};
  for (int k = 0; k < 5; ++k) {
    world.springs.push_back({.from = {.body = 0, .point = {0.1, 0.02 * k, 0.3 / (k + 1)}},
                             .to = {.body = {}, .point = {1.1 * k, 1. / (k + 3), 0.7}},
                             .stiffness = std::pow(7.3, k)});
  }
  const Load load = loadsOf(world)[0];
  int differ = 0;
  for (int k = 0; k < 120; ++k) {
    std::next_permutation(world.springs.begin(), world.springs.end(),
                          [](const Spring& x, const Spring& y) { return x.stiffness < y.stiffness; });
    const Load other = loadsOf(world)[0];
    differ += other.force == load.force && other.torque == load.torque ? 0 : 1;
  }
  EXPECT_EQ(differ, 0);
}

// The ends meet: no line joins them, so there is nothing to pull along, whatever the rest length.
TEST(Springs, ofNoLengthPullNowhere) {
  World world;
  world.bodies = {heavyBox("a", {0, 0, 0})};
  world.bodies[0].initial.velocity = {1, 2, 3};
  world.springs = {{.from = {.body = 0},
                    .to = {.body = {}, .point = {0, 0, 0}},
                    .stiffness = 2,
                    .damping = 3,
                    .restLength = 1}};
  const Load load = loadsOf(world)[0];
  EXPECT_EQ(load.force, Vec3::Zero());
  EXPECT_EQ(load.torque, Vec3::Zero());
  EXPECT_EQ(dissipation(world, statesOf(world)), 0);
}

/// A spring along x from a moving body to the world, with damping alone.
World damped(const Vec3& velocity) {
  World world;
  world.bodies = {heavyBox("a", {0, 0, 0})};
  world.bodies[0].initial.velocity = velocity;
  world.springs = {{.from = {.body = 0}, .to = {.body = {}, .point = {2, 0, 0}}, .damping = 3}};
  return world;
}

TEST(Springs, dampAlongTheirLineOnly) {
  EXPECT_EQ(loadsOf(damped({0, 5, -7}))[0].force, Vec3::Zero()) << "across: nothing";
  EXPECT_EQ(loadsOf(damped({-2, 5, -7}))[0].force, Vec3(6, 0, 0)) << "lengthening: held back";
  EXPECT_EQ(loadsOf(damped({2, 5, -7}))[0].force, Vec3(-6, 0, 0)) << "shortening: held back too";
}

TEST(Springs, dampTheMotionOfATurningCorner) {
  World world;
  world.bodies = {heavyBox("a", {0, 0, 0})};
  Body& body = world.bodies[0];
  body.initial.angularMomentum = angularMomentum(body.mass, Mat3::Identity(), {0, 0, 5});
  // The corner at y = 0.2 moves with −1 m/s along x: the spring lengthens by 1 m/s.
  world.springs = {
      {.from = {.body = 0, .point = {0, 0.2, 0}}, .to = {.body = {}, .point = {2, 0.2, 0}}, .damping = 3}};
  EXPECT_LT((loadsOf(world)[0].force - Vec3(3, 0, 0)).norm(), 1e-14);  // measured 0
}

TEST(Dissipation, isNeverAGain) {
  // c rate² = 3 · 4, whichever way it goes.
  EXPECT_EQ(dissipation(damped({2, 0, 0}), statesOf(damped({2, 0, 0}))), -12);
  EXPECT_EQ(dissipation(damped({-2, 0, 0}), statesOf(damped({-2, 0, 0}))), -12);
  World world = damped({0, 0, 0});
  world.springs.clear();
  world.drag = Drag{.linear = 0.5, .angular = 0.25};
  world.bodies[0] = makeBox({.velocity = {2, 0, 0}, .angularVelocity = {0, 4, 0}});
  EXPECT_NEAR(dissipation(world, statesOf(world)), -0.5 * 4 - 0.25 * 16, 1e-14);
}

// All the power of the loads on the bodies goes into spring energy or is dissipated: d/dt ½k x² = k x ẋ.
TEST(Dissipation, isWhatTheLoadsDoBesidesFillingTheSprings) {
  World world;
  world.bodies = {heavyBox("a", {0, 0, 0}), heavyBox("b", {1, 2, 0.5})};
  world.bodies[0].initial.velocity = {1, -2, 3};
  world.bodies[0].initial.angularMomentum = {1, 2, -1};
  world.bodies[1].initial.angularMomentum = {3, 1, -2};
  world.springs = {{.from = {.body = 0, .point = {0.1, 0.2, 0.3}},
                    .to = {.body = 1, .point = {-0.1, 0.2, -0.3}},
                    .stiffness = 30,
                    .damping = 2,
                    .restLength = 0.5}};
  world.drag = Drag{.linear = 0.4, .angular = 0.1};
  const std::vector<BodyState> states = statesOf(world);
  const std::vector<Load> loads = loadsOf(world);
  double power = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    power += loads[i].force.dot(states[i].velocity) +
             loads[i].torque.dot(angularVelocity(world.bodies[i].mass, states[i]));
  }
  const Stretch stretch = stretchOf(world.springs[0], world, states);
  const double filling = 30 * (stretch.length - 0.5) * stretch.rate;
  EXPECT_NEAR(power, dissipation(world, states) - filling, 1e-12);  // measured 1.1e-13
  EXPECT_LT(dissipation(world, states), -1);
}

TEST(Pulls, areGravityOrWhatSpringsGiveNowOrSoon) {
  World world;
  world.gravity = {0, 0, -3};
  world.bodies = {
      makeBox({.halfExtents = {0.5, 0.5, 0.5}, .density = 2}),  // 2 kg
      makeBox({.halfExtents = {0.5, 0.5, 0.5}, .position = {3, 0, 0}, .velocity = {0, 4, 0}, .density = 1}),
      makeBox({.halfExtents = {0.5, 0.5, 0.5}, .position = {9, 0, 0}, .density = 1})};
  world.springs = {{.from = {.body = 0}, .to = {.body = 1}, .stiffness = 16, .restLength = 1}};
  const std::vector<double> all = pulls(world, statesOf(world));
  EXPECT_DOUBLE_EQ(all[0], 16 * 2 / 2.0);
  EXPECT_DOUBLE_EQ(all[1], 16 * 2 + 4 * 4);
  EXPECT_DOUBLE_EQ(all[2], 3);
}

}  // namespace
}  // namespace careen
