#include "physics/contact/time_stepper.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "physics/geometry/separation.h"
#include "support/exact_runs.h"

namespace careen {
namespace {

constexpr double kTolerance = 1e-6;

std::vector<TouchingBody> touching(const World& world) {
  std::vector<TouchingBody> bodies;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    bodies.push_back({.body = &body,
                      .index = static_cast<int>(i),
                      .position = body.initial.pose.position,
                      .worldFromBody = Quat(body.initial.pose.worldFromBody),
                      .velocity = body.initial.velocity});
    if (!bodies.back().isHeld()) {
      bodies.back().angularVelocityBody = body.mass.inverseInertiaBody.cwiseProduct(
          body.initial.pose.worldFromBody.transpose() * body.initial.angularMomentum);
    }
  }
  return bodies;
}

World floorWith(double friction, double restitution) {
  World world;
  world.gravity = Vec3(0, 0, -10);
  world.walls.push_back({.name = "floor",
                         .normal = Vec3::UnitZ(),
                         .offset = 0,
                         .material = {.restitution = restitution, .friction = friction}});
  return world;
}

// Falls 0.2 m in 0.2 s, lands flat at 2 m/s and leaves with e times that.
TEST(TimeStepper, locatesAnImpactAndGivesBackItsRestitution) {
  for (const double restitution : {0.0, 0.5, 1.0}) {
    World world = floorWith(0.5, restitution);
    world.bodies.push_back(
        box("cube", Vec3(0.1, 0.1, 0.1), 1, Vec3(0, 0, 0.3), Vec3::Zero(), Vec3::Zero(), 0));
    const std::vector<TouchingBody> bodies = touching(world);
    TimeStepper stepper(world, bodies, kTolerance);
    double time = 0;
    double struck = -1;
    while (time < 0.21) {
      const double start = time;
      time += stepper.step(0.01);
      if (!stepper.impacts().empty() && struck < 0) {
        struck = start;
        EXPECT_EQ(stepper.impacts().size(), 4U);
        EXPECT_NEAR(stepper.impacts()[0].share.approach, 2, 1e-5);
      }
    }
    EXPECT_NEAR(struck, 0.2, 1e-6);
    const double since = time - 0.2;
    EXPECT_NEAR(stepper.state()[0].velocity.z(), restitution > 0 ? 2 * restitution - 10 * since : 0, 1e-5);
    EXPECT_LT(stepper.deepest(), kTolerance);
  }
}

// A light box between two heavy ones, with friction: no contact forces exist at times, and no gravity sets
// the length of a step. Seen at moments between steps, too, nothing goes through anything.
TEST(TimeStepper, jammedBoxesStayOutOfEachOther) {
  World world;
  for (const double at : {-0.4, 0.0, 0.4}) {
    Body body = box(at < 0   ? "a"
                    : at > 0 ? "c"
                             : "b",
                    Vec3(0.18, 0.2, 0.22), at == 0 ? 1 : 600, Vec3(at, 0.02 * at, 0), Vec3(-2 * at, 0, 0),
                    Vec3(at, 1 - at, 0.5), 0);
    body.material.friction = 1;
    world.bodies.push_back(body);
  }
  const std::vector<TouchingBody> bodies = touching(world);
  TimeStepper stepper(world, bodies, kTolerance);
  const auto momentum = [&] {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      const GroupBody& body = stepper.state()[i];
      const Vec3 linear = world.bodies[i].mass.mass * body.velocity;
      sum += body.position.cross(linear) + body.angularMomentum;
    }
    return sum;
  };
  const Vec3 before = momentum();
  double time = 0;
  double deepest = 0;
  int steps = 0;
  for (; time < 0.4 && steps < 20000; ++steps) {
    const double length = stepper.step(0.01);
    time += length;
    for (const double part : {0.3, 0.7, 1.0}) {
      std::vector<Pose> poses;
      for (std::size_t i = 0; i < 3; ++i) {
        poses.push_back(stateAt(Motion(stepper.motion(i)), world.bodies[i].mass, part * length).pose);
      }
      for (std::size_t i = 0; i < 2; ++i) {
        deepest = std::max(deepest, -BoxAxes({poses[i], world.bodies[i].halfExtents},
                                             {poses[i + 1], world.bodies[i + 1].halfExtents})
                                         .gap());
      }
    }
  }
  EXPECT_GE(time, 0.4) << steps;
  EXPECT_LT(deepest, kTolerance);
  EXPECT_LT((momentum() - before).norm(), 1e-6 * 600);
}

TEST(TimeStepper, aCutStepEndsWhereItsMotionWas) {
  World world = floorWith(0.5, 0);
  world.bodies.push_back(
      box("cube", Vec3(0.1, 0.1, 0.1), 1, Vec3(0, 0, 0.1), Vec3(1, 0, 0), Vec3::Zero(), 0));
  const std::vector<TouchingBody> bodies = touching(world);
  TimeStepper stepper(world, bodies, kTolerance);
  stepper.step(0.01);
  const double length = stepper.step(0.01);
  const Vec3 there = stateAt(Motion(stepper.motion(0)), world.bodies[0].mass, 0.25 * length).pose.position;
  stepper.cutTo(0.25 * length);
  EXPECT_EQ(stepper.state()[0].position, there);
  EXPECT_EQ(stepper.length(), 0.25 * length);
}

TEST(TimeStepper, whatHardlyMovesIsQuiet) {
  for (const double speed : {0.0, 1e-3}) {
    World world = floorWith(0.5, 0);
    world.bodies.push_back(
        box("cube", Vec3(0.1, 0.1, 0.1), 1, Vec3(0, 0, 0.1), Vec3(speed, 0, 0), Vec3::Zero(), 0));
    const std::vector<TouchingBody> bodies = touching(world);
    const TimeStepper stepper(world, bodies, kTolerance);
    EXPECT_EQ(stepper.isQuiet(), speed == 0);
    EXPECT_EQ(stepper.touching().size(), 4U);
  }
}

}  // namespace
}  // namespace careen
