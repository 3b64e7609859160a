#include "physics/world/diagnostics.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/math/rotation.h"
#include "physics/simulate.h"
#include "physics/world/method.h"
#include "support/physics_worlds.h"

namespace careen {
namespace {

/// One box of 8 kg with half sizes 1 m (I = 16/3), at 3 m height.
World oneBox() {
  World world;
  world.bodies = {makeBox({.halfExtents = {1, 1, 1},
                           .position = {0, 0, 3},
                           .velocity = {1, 2, 2},
                           .angularVelocity = {0, 3, 0},
                           .density = 1})};
  return world;
}

RunFigures run(const World& world, double duration, double dt) {
  Memory memory;
  return simulate(world, {.method = Method::kListing1, .duration = duration, .dt = dt}, memory);
}

TEST(Energy, isWorkedOutByHand) {
  World world = oneBox();
  world.gravity = {0, 0, -10};
  world.springs = {
      {.from = {.body = 0}, .to = {.body = {}, .point = {0, 0, 0}}, .stiffness = 5, .restLength = 1}};
  const Energy energy = energyOf(world, std::vector<BodyState>{world.bodies[0].initial});
  EXPECT_NEAR(energy.kinetic, 0.5 * 8 * 9 + 0.5 * 16.0 / 3 * 9, 1e-14);
  EXPECT_EQ(energy.gravitational, 8 * 10 * 3);
  EXPECT_EQ(energy.springs, 0.5 * 5 * 4);
  EXPECT_EQ(energy.total(), energy.kinetic + energy.gravitational + energy.springs);
  EXPECT_EQ(linearMomentum(world, std::vector<BodyState>{world.bodies[0].initial}), Vec3(8, 16, 16));
}

TEST(Energy, ofAHeldBodyIsNone) {
  World world = oneBox();
  world.gravity = {0, 0, -10};
  world.bodies[0].mass = immovable();
  EXPECT_EQ(energyOf(world, std::vector<BodyState>{world.bodies[0].initial}).total(), 0);
}

// From 60 J (36 + 24) to 36 + 0.9² · 24 and back: the largest change counts, not the last.
TEST(RunAccount, remembersTheLargestEnergyChange) {
  const World world = oneBox();
  const std::vector<BodyState> start = {world.bodies[0].initial};
  std::vector<BodyState> slower = start;
  slower[0].angularMomentum *= 0.9;
  RunAccount account(world, start);
  account.reached(slower, 0);
  account.reached(start, 0);
  EXPECT_NEAR(account.figures().energyChange, 0.19 * 24 / 60, 1e-15);
}

// A method that makes energy out of nothing is measured by what there should have been: 100 %, not 50.
TEST(RunAccount, doesNotDivideByEnergyFromNowhere) {
  const World world = oneBox();
  std::vector<BodyState> states = {world.bodies[0].initial};
  RunAccount account(world, states);
  states[0].velocity *= std::sqrt(2.0);
  states[0].angularMomentum *= std::sqrt(2.0);
  account.reached(states, 0);
  EXPECT_NEAR(account.figures().energyChange, 1, 1e-14);
}

TEST(RunAccount, takesWhatImpactsTakeOutAsAccountedFor) {
  const World world = oneBox();
  std::vector<BodyState> states = {world.bodies[0].initial};
  RunAccount account(world, states);
  states[0].velocity = {1, 2, -1};  // 12 J less
  account.struck(-12);
  account.reached(states, 0);
  EXPECT_LT(account.figures().energyChange, 1e-15);
}

// p = (8, 16, 16), of size 24; 3 kg m/s too much once, 3 too much again: 6 of the largest |p|.
TEST(RunAccount, addsUpMomentumThatNoForceGave) {
  const World world = oneBox();
  const std::vector<BodyState> start = {world.bodies[0].initial};
  std::vector<BodyState> next = start;
  next[0].velocity.x() += 1;
  const std::vector<Load> loads = {{.force = {50, 0, 0}}};
  RunAccount account(world, start);
  account.moved(start, next, loads, 0.1);
  account.moved(start, next, loads, 0.1);
  EXPECT_NEAR(account.figures().momentumChange, 6 / std::sqrt(16.0 * 16 + 16 * 16 + 16 * 16), 1e-14);
}

TEST(RunAccount, watchesTheAngularMomentumToo) {
  const World world = oneBox();  // L = (0, 16, 0)
  const std::vector<BodyState> start = {world.bodies[0].initial};
  std::vector<BodyState> next = start;
  next[0].angularMomentum.z() += 4;
  const std::vector<Load> loads = {{.torque = {0, 0, 20}}};
  RunAccount account(world, start);
  account.moved(start, next, loads, 0.1);
  EXPECT_NEAR(account.figures().momentumChange, 2 / std::sqrt(16.0 * 16 + 4 * 4), 1e-15);
}

TEST(RunAccount, keepsTheWorstOrthogonalityAndDepth) {
  const World world = oneBox();
  const std::vector<BodyState> start = {world.bodies[0].initial};
  std::vector<BodyState> bent = start;
  bent[0].pose.worldFromBody *= 2;
  const std::vector<Load> loads(1);
  RunAccount account(world, start);
  account.moved(start, bent, loads, 0.1);
  account.moved(start, start, loads, 0.1);
  account.reached(start, 0.25);
  account.reached(start, 0.125);
  EXPECT_NEAR(account.figures().orthogonality, 3 * std::sqrt(3.0), 1e-15);
  EXPECT_EQ(account.figures().deepestPenetration, 0.25);
}

TEST(RunAccount, ofAWorldWithoutMotionIsClean) {
  World world = oneBox();
  world.bodies[0].initial.velocity = Vec3::Zero();
  world.bodies[0].initial.angularMomentum = Vec3::Zero();
  const RunFigures figures = run(world, 1, 0.1);
  EXPECT_EQ(figures.energyChange, 0);
  EXPECT_EQ(figures.momentumChange, 0);
  EXPECT_EQ(figures.orthogonality, 0);
  EXPECT_EQ(figures.deepestPenetration, 0);
}

// A body whose three moments are equal turns by Listing 1 with constant energy, and without forces it flies
// exactly: what is left unaccounted after inelastic impacts on all sides is rounding.
TEST(RunFigures, showRoundingAloneWhereTheMethodIsExact) {
  World world =
      sampleRoom(makeBox({.velocity = {3, 2, 1}, .angularVelocity = {1, 2, 3}, .restitution = 0.5}));
  Memory memory;
  const RunFigures figures =
      simulate(world, {.method = Method::kListing1, .duration = 10, .dt = 1.0 / 60}, memory);
  EXPECT_GE(memory.impacts.size(), 5U) << "measured 8";
  const double left = energyOf(world, std::vector<BodyState>{memory.last()}).kinetic;
  const double had = energyOf(world, std::vector<BodyState>{world.bodies[0].initial}).kinetic;
  EXPECT_LT(left / had, 0.6) << "measured 0.12: much was taken out, all of it accounted for";
  EXPECT_LT(figures.energyChange, 1e-14);    // measured 1.5e-16
  EXPECT_LT(figures.momentumChange, 1e-14);  // measured 0
  EXPECT_LT(figures.orthogonality, 3e-15);   // measured 8.6e-16
}

// Only the gain of explicit Euler in free fall is left: ½ m g² h² per step, so ½ m g² h t, of m g² t²/2 at
// the end.
TEST(RunFigures, showTheGainOfEulerInFreeFall) {
  World world = oneBox();
  world.bodies[0].initial.velocity = Vec3::Zero();
  world.bodies[0].initial.angularMomentum = Vec3::Zero();
  world.gravity = {0, 0, -10};
  // Due at the end: m g z by the fallen height, ½ g t (t − h).
  EXPECT_NEAR(run(world, 2, 0.25).energyChange, 0.25 / (2 - 0.25), 1e-13);  // measured 0
}

// Drag's work is accounted for by the trapezoid: what remains is the method's error, of first order.
TEST(RunFigures, countTheWorkOfDragAndDamping) {
  World world = oneBox();
  world.drag = Drag{.linear = 8, .angular = 2};
  world.springs = {{.from = {.body = 0, .point = {1, 1, 1}},
                    .to = {.body = {}, .point = {4, 0, 0}},
                    .stiffness = 5,
                    .damping = 3}};
  std::array<double, 3> change{};
  for (std::size_t i = 0; i < change.size(); ++i) {
    change.at(i) = run(world, 2, 0.001 / (1 << i)).energyChange;
  }
  EXPECT_LT(change[0], 0.003);                            // measured 0.0022
  EXPECT_NEAR(std::log2(change[0] / change[1]), 1, 0.1);  // measured 1.002
  EXPECT_NEAR(std::log2(change[1] / change[2]), 1, 0.1);  // measured 1.001
}

}  // namespace
}  // namespace careen
