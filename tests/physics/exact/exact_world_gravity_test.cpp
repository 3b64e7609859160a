// Gravity that changes, against closed forms: errors beside what was measured.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/math/rotation.h"
#include "physics/world/world.h"
#include "support/exact_runs.h"
#include "support/jointed.h"

namespace careen {
namespace {

constexpr double kWeight = 9.81;
const Vec3 kDown(0, 0, -kWeight);

World onFloor(double friction) {
  World world;
  world.gravity = kDown;
  world.bodies = {box("box", Vec3::Constant(0.1), 1, Vec3(0, 0, 0.1), Vec3::Zero(), Vec3::Zero(), 0)};
  world.bodies[0].material.friction = friction;
  world.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
  world.walls[0].material.friction = friction;
  return world;
}

// 2e-16 m off. Torque-free turning does not notice: the same attitude as without gravity, to 7e-15.
TEST(ExactWorldGravity, flightIsOneParabolaAfterAnother) {
  World world;
  world.gravity = Vec3(0, 0, -10);
  world.gravityChanges = {{.time = 0.5, .gravity = Vec3(3, 0, 0)}, {.time = 1.25, .gravity = Vec3(0, 2, 10)}};
  world.bodies = {box("box", Vec3(0.1, 0.2, 0.3), 1, Vec3::Zero(), Vec3(1, 0, 4), Vec3(3, 4, 5))};
  const Recorded run = runFor(world, 2);
  World without = world;
  without.gravity.setZero();
  without.gravityChanges.clear();
  const Recorded free = runFor(without, 2);
  for (const double time : {0.3, 0.5, 0.8, 1.3, 2.0}) {
    const double first = std::min(time, 0.5);
    const double second = std::clamp(time - 0.5, 0.0, 0.75);
    const double third = std::max(0.0, time - 1.25);
    const Vec3 v1 = Vec3(1, 0, 4) + first * Vec3(0, 0, -10);
    const Vec3 v2 = v1 + second * Vec3(3, 0, 0);
    const Vec3 due = first * (Vec3(1, 0, 4) + 0.5 * first * Vec3(0, 0, -10)) +
                     second * (v1 + 0.5 * second * Vec3(3, 0, 0)) +
                     third * (v2 + 0.5 * third * Vec3(0, 2, 10));
    const BodyState state = run.at(world, 0, time);
    EXPECT_LT((state.pose.position - due).norm(), 1e-15) << time;
    EXPECT_LT((state.velocity - v2 - third * Vec3(0, 2, 10)).norm(), 4e-15) << time;
    EXPECT_LT((state.pose.worldFromBody - free.at(without, 0, time).pose.worldFromBody).norm(), 1.4e-14)
        << time;
  }
  EXPECT_LT(run.figures.energyChange, 1e-15);
}

// A vehicle brakes with .8 g for .3 s: its load slides with .4 g of friction, and as far again until it
// stops. 2e-13 m off.
TEST(ExactWorldGravity, aLoadSlidesWhereItsVehicleBrakes) {
  World world = onFloor(0.4);
  world.gravityChanges = {{.time = 1, .gravity = Vec3(0.8 * kWeight, 0, -kWeight)},
                          {.time = 1.3, .gravity = kDown}};
  const double speed = 0.4 * kWeight * 0.3;
  const double way = 0.5 * speed * 0.3 + speed * speed / (2 * 0.4 * kWeight);
  const Recorded run = runFor(world, 3);
  EXPECT_EQ(run.at(world, 0, 1).pose.position, Vec3(0, 0, 0.1));
  EXPECT_NEAR(run.at(world, 0, 1.3).velocity.x(), speed, 1e-12);
  EXPECT_NEAR(run.last(world, 0, 3).pose.position.x(), way, 1e-12);
  EXPECT_TRUE(std::holds_alternative<Rest>(run.motions[0].back().second));
  world.gravityChanges[0].gravity.x() = 0.39 * kWeight;  // friction holds it
  EXPECT_EQ(runFor(world, 3).last(world, 0, 3).pose.position, Vec3(0, 0, 0.1));
}

// It rises under gravity upwards, from the moment on at which that begins.
TEST(ExactWorldGravity, whatRestsFeelsIt) {
  World world = onFloor(0.4);
  world.gravityChanges = {{.time = 0.5, .gravity = Vec3::Zero()}, {.time = 1, .gravity = Vec3(0, 0, 4)}};
  const Recorded run = runFor(world, 2);
  EXPECT_EQ(run.at(world, 0, 0.9).pose.position, Vec3(0, 0, 0.1));
  EXPECT_NEAR(run.last(world, 0, 2).pose.position.z(), 0.1 + 2, 1e-15);
}

// Without gravity nothing tells how fast is slow: with it a box that falls .4 m bounces with .8 of its speed.
TEST(ExactWorldGravity, setsTheScaleOfWhatBounces) {
  World world = onFloor(0);
  world.gravity.setZero();
  world.walls[0].material.restitution = 0.8;
  world.bodies[0].initial.pose.position.z() = 0.5;
  world.gravityChanges = {{.time = 0.5, .gravity = kDown}};
  const double speed = std::sqrt(2 * kWeight * 0.4);
  const double lands = 0.5 + speed / kWeight;
  const Recorded run = runFor(world, lands + 0.1);
  EXPECT_NEAR(run.last(world, 0, lands + 0.1).velocity.z(), 0.8 * speed - 0.1 * kWeight, 1e-12);
}

// A pendulum of which gravity is turned off goes on with its speed: a bar about its end, from horizontal.
// 1e-8 rad off, of a tolerance of 1e-6 m.
TEST(ExactWorldGravity, jointedBodiesFeelIt) {
  World world;
  world.gravity = kDown;
  world.bodies = {test::bar("bar", 0.5)};
  test::join(world, Joint::Kind::kHinge, 0, {}, Vec3::Zero(), Vec3::UnitY());
  world.gravityChanges = {{.time = 0.4, .gravity = Vec3::Zero()}};
  const Recorded run = runFor(world, 1.4);
  const double rate = angularVelocity(world.bodies[0].mass, run.at(world, 0, 0.4)).y();
  const Mat3 before = run.at(world, 0, 0.4).pose.worldFromBody;
  const Mat3 turned = before.transpose() * run.last(world, 0, 1.4).pose.worldFromBody;
  EXPECT_GT(std::fabs(rate), 1.5);
  EXPECT_NEAR(
      std::remainder(Eigen::AngleAxisd(turned).angle() * (Eigen::AngleAxisd(turned).axis().y()) - rate,
                     2 * 3.14159265358979323846),
      0, 4e-8);
}

// A crowd that has come to rest on a floor that then is a slope slides off as each box by itself: 40 boxes at
// some distance, friction .2 under a slope of tan = .5. Half a second later, 5e-4 m off, of a crowd's
// tolerance of 3e-4 m.
TEST(ExactWorldGravity, crowdsFeelIt) {
  World world = onFloor(0.2);
  const Body one = world.bodies[0];
  world.bodies.clear();
  for (int k = 0; k < 40; ++k) {
    world.bodies.push_back(one);
    world.bodies.back().name = "box" + std::to_string(k);
    world.bodies.back().initial.pose.position = Vec3(0.2 * (k % 8), 0.2 * (k / 8), 0.1);
  }
  world.gravityChanges = {{.time = 0.5, .gravity = Vec3(0.5 * kWeight, 0, -kWeight)}};
  Recorded run;
  run.motions.resize(world.bodies.size());
  Notes notes(run);
  const RunSettings settings{.duration = 1, .crowds = {.when = CrowdSettings::When::kAbove, .above = 0}};
  ExactWorld(world, settings, notes).run({});
  const double way = 0.5 * (0.5 - 0.2) * kWeight * 0.25;
  for (std::size_t body = 0; body < world.bodies.size(); ++body) {
    const Vec3 moved = run.last(world, body, 1).pose.position - world.bodies[body].initial.pose.position;
    EXPECT_NEAR(moved.x(), way, 1.2e-3) << body;
    EXPECT_NEAR(moved.z(), 0, 2e-5) << body;
  }
}

}  // namespace
}  // namespace careen
