// Fixed boxes that move by themselves, against closed forms and by the frame that moves with them: errors
// beside what was measured, at a tolerance of 1e-6.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support/exact_runs.h"

namespace careen {
namespace {

constexpr double kPullOfCourses = 9.81;
constexpr double kPi = 3.14159265358979324;

Body mover(const std::string& name, const Vec3& halfExtents, const Vec3& position,
           const PrescribedMotion& motion, const Material& material = {}) {
  Body body;
  body.name = name;
  body.halfExtents = halfExtents;
  body.material = material;
  body.course = courseOf(motion, {.position = position});
  body.initial = stateOf(body.course.front().at(0));
  return body;
}

Body cube(const std::string& name, const Vec3& position, double friction, double restitution = 0) {
  Body body = box(name, Vec3::Constant(0.1), 1, position, Vec3::Zero(), Vec3::Zero(), restitution);
  body.material.friction = friction;
  return body;
}

World heavy() {
  World world;
  world.gravity = Vec3(0, 0, -kPullOfCourses);
  return world;
}

// A ball of −1 m/s meets a racket of 2 m/s after 1.8/3 s: it leaves at 2 + 3 e. To rounding.
TEST(ExactWorldCourse, aRacketGivesItsSpeedTwice) {
  for (const double restitution : {1.0, 0.5}) {
    World world;
    world.bodies = {
        mover("racket", Vec3(0.1, 0.5, 0.5), Vec3(-1, 0, 0), {.path = {}, .velocity = Vec3(2, 0, 0)}, {}),
        box("ball", Vec3::Constant(0.1), 1, Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3::Zero(), restitution)};
    const Recorded run = runFor(world, 2);
    ASSERT_EQ(run.moments(), 1U);
    EXPECT_NEAR(run.impacts[0].time, 0.6, 1e-15);
    EXPECT_NEAR(run.impacts[0].approach, 3, 1e-14);
    const double after = 2 + 3 * restitution;
    EXPECT_NEAR(run.last(world, 1, 2).velocity.x(), after, 4e-15);
    EXPECT_NEAR(run.last(world, 1, 2).pose.position.x(), 0.4 + 1.4 * after, 1e-14);
  }
}

// A door that turns at 2 rad/s about the origin strikes a ball at rest above it: first the corner that is
// farthest out, at 1.1 m, where its face moves at 2.2 m/s along its normal. To rounding.
TEST(ExactWorldCourse, aDoorStrikesAsFastAsItIsThere) {
  World world;
  world.bodies = {mover("door", Vec3(0.6, 0.1, 0.5), Vec3(0.6, 0, 0),
                        {.path = {}, .angularVelocity = Vec3(0, 0, 2), .about = Vec3::Zero()}, {}),
                  box("ball", Vec3::Constant(0.1), 1, Vec3(1, 0.2, 0), Vec3(0, 0, 0), Vec3::Zero(), 1)};
  const Recorded run = runFor(world, 0.01);
  ASSERT_GE(run.impacts.size(), 1U);
  EXPECT_NEAR(run.impacts[0].approach, 2.2, 1e-14);
}

// A lift that swings up and down with less than g carries what stands on it: 2.5e-11 m and 1.6e-9 m/s off.
TEST(ExactWorldCourse, aLiftCarries) {
  World world = heavy();
  const double rate = kPi;
  world.bodies = {mover("lift", Vec3(0.5, 0.5, 0.1), Vec3::Zero(),
                        {.path = {}, .amplitude = Vec3(0, 0, 0.3), .rate = rate}, {.friction = 0.5}),
                  cube("load", Vec3(0, 0, 0.2), 0.5)};
  const Recorded run = runFor(world, 3);
  for (const double time : {0.5, 1.25, 3.0}) {
    EXPECT_NEAR(run.at(world, 1, time).pose.position.z(), 0.2 + 0.3 * std::sin(rate * time), 5e-11);
    EXPECT_NEAR(run.at(world, 1, time).velocity.z(), 0.3 * rate * std::cos(rate * time), 4e-9);
  }
}

// With more than g at the top, what stands on it leaves where A ω² sin ωt = g, and flies: the moment is a
// root. 8e-15 s off.
TEST(ExactWorldCourse, aFastLiftThrows) {
  World world = heavy();
  const double rate = 2 * kPi * 1.5;
  const double amplitude = 0.2;
  world.bodies = {mover("lift", Vec3(0.5, 0.5, 0.1), Vec3::Zero(),
                        {.path = {}, .amplitude = Vec3(0, 0, amplitude), .rate = rate, .phase = -kPi / 2}),
                  cube("load", Vec3(0, 0, 0.2 - amplitude), 0)};
  const Recorded run = runFor(world, 0.4);
  const double leaves = (std::asin(kPullOfCourses / (amplitude * rate * rate)) + kPi / 2) / rate;
  double flies = 0;
  for (const auto& [start, motion] : run.motions[1]) {
    flies = flies == 0 && start > 0.1 && std::holds_alternative<Flight>(motion) ? start : flies;
  }
  EXPECT_NEAR(flies, leaves, 1e-13);
  const double up = amplitude * rate * std::cos(rate * leaves - kPi / 2);
  const double since = 0.3 - leaves;
  EXPECT_NEAR(run.at(world, 1, 0.3).pose.position.z(),
              0.2 + kPullOfCourses / (rate * rate) + since * (up - 0.5 * kPullOfCourses * since), 1e-14);
}

// Newmark's block: a table that shakes to and fro with up to 11.8 m/s², more than the 2.9 of friction; slip
// begins and ends by turns. The oracle is the equation of one block, integrated with 1e-6 s steps: 3.5e-7 m
// off.
TEST(ExactWorldCourse, aBlockOnAShakingTableSlips) {
  World world = heavy();
  const double rate = 2 * kPi;
  const double amplitude = 0.3;
  const double mu = 0.3;
  world.bodies = {mover("table", Vec3(2, 2, 0.1), Vec3::Zero(),
                        {.path = {}, .amplitude = Vec3(amplitude, 0, 0), .rate = rate}, {.friction = mu}),
                  cube("block", Vec3(0, 0, 0.2), mu)};
  const Recorded run = runFor(world, 2);
  double x = 0;
  double v = 0;
  constexpr double kStep = 1e-6;
  for (int k = 0; k < 2'000'000; ++k) {
    const double middle = (k + 0.5) * kStep;
    const double slip = v - amplitude * rate * std::cos(rate * middle);
    const double most = mu * kPullOfCourses;
    const double follows = -amplitude * rate * rate * std::sin(rate * middle);
    const bool sticks = std::fabs(slip) < 2 * most * kStep && std::fabs(follows) <= most;
    const double a = sticks ? follows : slip > 0 ? -most : most;
    x += kStep * (v + 0.5 * kStep * a);
    v += kStep * a;
  }
  EXPECT_NEAR(run.last(world, 1, 2).pose.position.x(), x, 7e-7);
  EXPECT_NEAR(run.last(world, 1, 2).velocity.x(), v, 7e-7);
}

// It sticks where friction is enough: it moves as the table: 2.9e-9 m off.
TEST(ExactWorldCourse, aBlockOnAGentleTableSticks) {
  World world = heavy();
  world.bodies = {mover("table", Vec3(2, 2, 0.1), Vec3::Zero(),
                        {.path = {}, .amplitude = Vec3(0.05, 0, 0), .rate = 2 * kPi, .phase = kPi / 2},
                        {.friction = 0.3}),
                  cube("block", Vec3(0.05, 0, 0.2), 0.3)};
  const Recorded run = runFor(world, 2.3);
  EXPECT_NEAR(run.last(world, 1, 2.3).pose.position.x(), 0.05 * std::cos(2 * kPi * 2.3), 6e-9);
}

// A lift that stops lets what stands on it fly: it was going up at 1 m/s, and comes back down after 2 v/g. To
// rounding.
TEST(ExactWorldCourse, aLiftThatStopsThrows) {
  World world = heavy();
  world.bodies = {mover("lift", Vec3(0.5, 0.5, 0.1), Vec3::Zero(),
                        {.path = {{0.5, Vec3(0, 0, 0)}, {1.5, Vec3(0, 0, 1)}}}, {.friction = 0.5}),
                  cube("load", Vec3(0, 0, 0.2), 0.5)};
  const Recorded run = runFor(world, 3);
  EXPECT_NEAR(run.at(world, 1, 1).pose.position.z(), 0.7, 1e-14);
  EXPECT_NEAR(run.at(world, 1, 1.6).pose.position.z(), 1.2 + 0.1 - 0.5 * kPullOfCourses * 0.01, 1e-14);
  EXPECT_NEAR(run.impacts.back().time, 1.5 + 2 / kPullOfCourses, 1e-14);
  EXPECT_NEAR(run.last(world, 1, 3).pose.position.z(), 1.2, 1e-14);
  EXPECT_TRUE(std::holds_alternative<Rest>(run.motions[1].back().second));
}

// A pusher against friction moves its box at its own speed: it does μ m g v t. To rounding.
TEST(ExactWorldCourse, aPusherPushes) {
  World world = heavy();
  world.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
  world.walls[0].material.friction = 0.4;
  world.bodies = {
      mover("pusher", Vec3(0.1, 0.3, 0.09), Vec3(-0.5, 0, 0.1), {.path = {}, .velocity = Vec3(0.5, 0, 0)}),
      cube("box", Vec3(0, 0, 0.1), 0.4)};
  const Recorded run = runFor(world, 3);
  const BodyState end = run.last(world, 1, 3);
  EXPECT_NEAR(end.pose.position.x(), -0.5 + 1.5 + 0.2, 1e-14);
  EXPECT_NEAR(end.velocity.x(), 0.5, 1e-14);
  EXPECT_NEAR(end.pose.position.z(), 0.1, 1e-14);
}

// A whole scene in a frame that moves evenly: a table that stands, and one that moves with all on it. Of 30
// tosses, 6e-6 m off at the most, as the tolerance of 1e-6 m grows in tosses.
TEST(ExactWorldCourse, aFrameThatMovesEvenlyIsAsGoodAsAnother) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int toss = 0; toss < 30; ++toss) {
    const Vec3 frame(any(random), any(random), any(random));
    World still = heavy();
    still.bodies = {mover("table", Vec3(3, 3, 0.2), Vec3::Zero(), {}, {.restitution = 0.3, .friction = 0.4}),
                    cube("box", Vec3(0, 0, 0.6), 0.4)};
    Body& tossed = still.bodies[1];
    tossed.initial.velocity = Vec3(any(random), any(random), any(random));
    tossed.initial.angularMomentum =
        angularMomentum(tossed.mass, Mat3::Identity(), 3 * Vec3(any(random), any(random), any(random)));
    still.bodies[0].course.clear();
    World moving = still;
    moving.bodies[0].course = courseOf({.path = {}, .velocity = frame}, {});
    moving.bodies[0].initial = stateOf(moving.bodies[0].course.front().at(0));
    moving.bodies[1].initial.velocity += frame;
    const Recorded a = runFor(still, 0.8);
    const Recorded b = runFor(moving, 0.8);
    for (const double time : {0.2, 0.4, 0.6, 0.8}) {
      const BodyState expected = a.at(still, 1, time);
      const BodyState found = b.at(moving, 1, time);
      EXPECT_LT((found.pose.position - expected.pose.position - time * frame).norm(), 1e-5) << toss;
      EXPECT_LT((found.pose.worldFromBody - expected.pose.worldFromBody).norm(), 1e-4) << toss;
    }
  }
}

// As a crowd: 8e-6 m off on the lift.
TEST(ExactWorldCourse, crowdsAreDrivenToo) {
  World world = heavy();
  world.bodies = {mover("lift", Vec3(2, 2, 0.1), Vec3::Zero(),
                        {.path = {}, .amplitude = Vec3(0, 0, 0.3), .rate = kPi}, {.friction = 0.5})};
  for (int k = 0; k < 9; ++k) {
    world.bodies.push_back(cube("load" + std::to_string(k), Vec3(0.3 * (k % 3), 0.3 * (k / 3), 0.2), 0.5));
  }
  const Recorded run = runInCrowd(world, 3);
  for (std::size_t k = 1; k < world.bodies.size(); ++k) {
    EXPECT_NEAR(run.last(world, k, 3).pose.position.z(), 0.2 + 0.3 * std::sin(3 * kPi), 1e-6);
    EXPECT_NEAR(run.at(world, k, 1.25).pose.position.z(), 0.2 + 0.3 * std::sin(1.25 * kPi), 2e-5);
  }
}

// What lies on something that moves does not sleep; where that stops, it does. 7e-9 m off.
TEST(ExactWorldCourse, crowdsSleepWhereNothingMoves) {
  World world = heavy();
  world.bodies = {mover("lift", Vec3(2, 2, 0.1), Vec3::Zero(),
                        {.path = {{0, Vec3::Zero()}, {1, Vec3(0, 0, 0.5)}}}, {.friction = 0.5})};
  for (int k = 0; k < 4; ++k) {
    world.bodies.push_back(cube("load" + std::to_string(k), Vec3(0.3 * k, 0, 0.2), 0.5));
  }
  const Recorded run = runInCrowd(world, 3);
  EXPECT_NEAR(run.at(world, 1, 0.9).pose.position.z(), 0.65, 2e-10);
  EXPECT_TRUE(std::holds_alternative<Rest>(run.motions[1].back().second));
  EXPECT_NEAR(run.last(world, 1, 3).pose.position.z(), 0.7, 2e-8);
}

// A pusher that has already joined a crowd meets what sleeps beside it: both are as far as it takes them, to
// 7e-10 m.
TEST(ExactWorldCourse, aPusherInACrowdWakesWhatItMeetsNext) {
  World world = heavy();
  world.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
  world.walls[0].material.friction = 0.5;
  world.bodies = {mover("pusher", Vec3(0.1, 0.8, 0.09), Vec3::Zero(),
                        {.path = {{1, Vec3(-0.5, 0, 0.1)}, {3, Vec3(0.5, 0, 0.1)}}}),
                  cube("first", Vec3(0, -0.4, 0.1), 0.5), cube("second", Vec3(0.4, 0.4, 0.1), 0.5)};
  world.bodies[0].course =
      courseOf({.path = {{1, Vec3::Zero()}, {3, Vec3(1, 0, 0)}}}, {.position = Vec3(-0.5, 0, 0.1)});
  world.bodies[0].initial = stateOf(world.bodies[0].course.front().at(0));
  const Recorded run = runInCrowd(world, 4);
  for (const std::size_t body : {1U, 2U}) {
    EXPECT_NEAR(run.at(world, body, 2.9).pose.position.x(), 0.45 + 0.2, 2e-9);
    EXPECT_TRUE(std::holds_alternative<Rest>(run.motions[body].back().second));
  }
}

}  // namespace
}  // namespace careen
