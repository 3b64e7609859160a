#include "physics/contact/time_stepper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "physics/geometry/separation.h"
#include "support/touching_bodies.h"

namespace careen {
namespace {

constexpr double kTolerance = 1e-6;

TEST(TimeStepper, givesUpAStepThatCostsMoreThanItMay) {
  World world = floorWith(0.5, 0);
  world.bodies.push_back(
      box("cube", Vec3(0.1, 0.1, 0.1), 1, Vec3(0, 0, 0.1), Vec3(1, 0, 0), Vec3::Zero(), 0));
  const std::vector<TouchingBody> bodies = touching(world);
  TimeStepper sliding(world, bodies, kTolerance);
  EXPECT_GT(sliding.step(0.01), 0);
  const double cost = sliding.equations().work();
  EXPECT_GE(cost, 5);  // a body and its four corners
  EXPECT_NO_THROW(TimeStepper(world, bodies, kTolerance).step(0.01, cost));
  EXPECT_THROW(TimeStepper(world, bodies, kTolerance).step(0.01, cost - 1), NumericalError);
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

Body tumbling(const std::string& name, double mass, const Vec3& size, const Vec3& position,
              const Vec3& velocity, const Quat& attitude, const Vec3& spin) {
  Body body = box(name, size, mass, position, velocity, Vec3::Zero(), 0);
  BodyState& start = body.initial;
  start.pose.worldFromBody = attitude.normalized().toRotationMatrix();
  start.angularMomentum = angularMomentum(body.mass, start.pose.worldFromBody, spin);
  return body;
}

// From a squeeze. For 4 ms an edge of one would go into the other and out again: the gap falls along one
// direction and rises along another, which no bound on its curvature tells. Whether steps begin and end in
// that time depends on the first of them.
TEST(TimeStepper, whatGrazesWithinAStepIsMet) {
  World world;
  world.bodies.push_back(tumbling("b", 1, Vec3(0.25254, 0.259085, 0.26735),
                                  Vec3(0.015458, -0.168515, 0.393942), Vec3(-0.004121, -0.432831, 1.481173),
                                  Quat(0.078544, 0.007769, -0.991918, -0.099342),
                                  Vec3(0.672057, -0.839079, -0.025153)));
  world.bodies.push_back(tumbling("c", 5.428986, Vec3(0.201258, 0.260763, 0.187917),
                                  Vec3(0.477515, -0.031186, -0.07554), Vec3(-0.276159, 0.051288, -0.210441),
                                  Quat(0.622672, 0.249617, 0.430163, -0.604095),
                                  Vec3(0.562546, -1.699479, -0.953187)));
  const std::vector<TouchingBody> bodies = touching(world);
  for (int first = 1; first <= 24; ++first) {
    TimeStepper stepper(world, bodies, kTolerance);
    double deepest = 0;
    bool struck = false;
    for (double time = stepper.step(4e-4 * first); time < 0.1;) {
      time += stepper.step(0.1);
      struck = struck || !stepper.impacts().empty();
      for (int k = 0; k <= 20; ++k) {
        std::vector<Pose> poses;
        for (std::size_t i = 0; i < 2; ++i) {
          const Motion motion(stepper.motion(i));
          poses.push_back(stateAt(motion, world.bodies[i].mass, stepper.length() * k / 20).pose);
        }
        const BoxAxes axes({poses[0], world.bodies[0].halfExtents}, {poses[1], world.bodies[1].halfExtents});
        deepest = std::max(deepest, -axes.gap());
      }
    }
    EXPECT_LT(deepest, kTolerance) << first;
    EXPECT_TRUE(struck) << first;
  }
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
    TimeStepper stepper(world, bodies, kTolerance);
    EXPECT_EQ(stepper.isQuiet(), speed == 0);
    EXPECT_EQ(stepper.touching().size(), 4U);
  }
}

}  // namespace
}  // namespace careen
