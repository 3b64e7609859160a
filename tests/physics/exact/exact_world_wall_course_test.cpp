// Walls that move by themselves, against closed forms, by the frame that moves with them, and beside fixed
// boxes so large that they are the same: errors beside what was measured, at a tolerance of 1e-6.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support/exact_runs.h"

namespace careen {
namespace {

constexpr double kPullOnWalls = 9.81;
constexpr double kHalfTurn = 3.14159265358979324;

Wall movingWall(const Vec3& normal, const Vec3& point, const PrescribedMotion& motion,
                const Material& material = {}) {
  Wall wall{.name = "moving " + std::to_string(normal.z()),
            .normal = normal.normalized(),
            .material = material,
            .course = courseOf(motion, {.position = point})};
  wall.offset = planeAt(wall, 0).offset;
  return wall;
}

// A fixed box with the wall for a face, the middle of which is the wall's point.
Body boxBehind(const Wall& wall, const PrescribedMotion& motion, const Vec3& point, double size) {
  const Vec3 across = wall.normal.cross(std::fabs(wall.normal.z()) < 0.7 ? Vec3::UnitZ() : Vec3::UnitX());
  Pose home{.position = point - size * wall.normal};
  home.worldFromBody.col(0) = across.normalized();
  home.worldFromBody.col(1) = wall.normal.cross(across.normalized());
  home.worldFromBody.col(2) = wall.normal;
  Body body;
  body.name = "behind";
  body.halfExtents = Vec3(size, size, size);
  body.material = wall.material;
  body.course = courseOf(motion, home);
  body.initial = stateOf(body.course.front().at(0));
  return body;
}

Body load(const Vec3& position, double friction, double restitution = 0,
          const Vec3& half = Vec3::Constant(0.1), const std::string& name = "load") {
  Body body = box(name, half, 1, position, Vec3::Zero(), Vec3::Zero(), restitution);
  body.material.friction = friction;
  return body;
}

World pulledDown() {
  World world;
  world.gravity = Vec3(0, 0, -kPullOnWalls);
  return world;
}

// A wall that comes with 2 m/s strikes a ball that comes with 1 m/s after 0.6 s, which leaves with 2 + 3 e.
TEST(ExactWorldWallCourse, aWallGivesItsSpeedTwice) {
  for (const double restitution : {1.0, 0.5}) {
    World world;
    world.walls = {movingWall(Vec3::UnitX(), Vec3(-0.9, 0, 0), {.path = {}, .velocity = Vec3(2, 0, 0)})};
    world.bodies = {
        box("ball", Vec3::Constant(0.1), 1, Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3::Zero(), restitution)};
    const Recorded run = runFor(world, 2);
    ASSERT_EQ(run.moments(), 1U);
    EXPECT_NEAR(run.impacts[0].time, 0.6, 1e-15);
    EXPECT_NEAR(run.impacts[0].approach, 3, 1e-14);
    const double after = 2 + 3 * restitution;
    EXPECT_NEAR(run.last(world, 0, 2).velocity.x(), after, 4e-15);
    EXPECT_NEAR(run.last(world, 0, 2).pose.position.x(), 0.4 + 1.4 * after, 1e-14);
  }
}

// A wall that turns about the origin at 2 rad/s strikes a ball at rest where its face is as fast as it is far
// out: at the corner 1.1 m away.
TEST(ExactWorldWallCourse, aTurningWallStrikesAsFastAsItIsThere) {
  World world;
  world.walls = {movingWall(Vec3::UnitY(), Vec3::Zero(),
                            {.path = {}, .angularVelocity = Vec3(0, 0, 2), .about = Vec3::Zero()})};
  world.bodies = {box("ball", Vec3::Constant(0.1), 1, Vec3(1, 0.1, 0), Vec3::Zero(), Vec3::Zero(), 1)};
  const Recorded run = runFor(world, 0.01);
  ASSERT_GE(run.impacts.size(), 1U);
  EXPECT_NEAR(run.impacts[0].approach, 2.2, 1e-14);
}

// A floor that swings up and down with less than g carries what stands on it.
TEST(ExactWorldWallCourse, aFloorCarries) {
  World world = pulledDown();
  world.walls = {movingWall(Vec3::UnitZ(), Vec3::Zero(),
                            {.path = {}, .amplitude = Vec3(0, 0, 0.3), .rate = kHalfTurn},
                            {.friction = 0.5})};
  world.bodies = {load(Vec3(0, 0, 0.1), 0.5)};
  const Recorded run = runFor(world, 3);
  for (const double time : {0.5, 1.25, 3.0}) {
    EXPECT_NEAR(run.at(world, 0, time).pose.position.z(), 0.1 + 0.3 * std::sin(kHalfTurn * time), 5e-11);
    EXPECT_NEAR(run.at(world, 0, time).velocity.z(), 0.3 * kHalfTurn * std::cos(kHalfTurn * time), 4e-9);
  }
}

// With more than g at the top, what stands on it leaves where A ω² sin ωt = g: the moment is a root.
TEST(ExactWorldWallCourse, aFastFloorThrows) {
  World world = pulledDown();
  const double rate = 2 * kHalfTurn * 1.5;
  const double amplitude = 0.2;
  world.walls = {
      movingWall(Vec3::UnitZ(), Vec3::Zero(),
                 {.path = {}, .amplitude = Vec3(0, 0, amplitude), .rate = rate, .phase = -kHalfTurn / 2})};
  world.bodies = {load(Vec3(0, 0, 0.1 - amplitude), 0)};
  const Recorded run = runFor(world, 0.4);
  const double leaves = (std::asin(kPullOnWalls / (amplitude * rate * rate)) + kHalfTurn / 2) / rate;
  double flies = 0;
  for (const auto& [start, motion] : run.motions[0]) {
    flies = flies == 0 && start > 0.1 && std::holds_alternative<Flight>(motion) ? start : flies;
  }
  EXPECT_NEAR(flies, leaves, 1e-13);
  const double up = amplitude * rate * std::cos(rate * leaves - kHalfTurn / 2);
  const double since = 0.3 - leaves;
  EXPECT_NEAR(run.at(world, 0, 0.3).pose.position.z(),
              0.1 + kPullOnWalls / (rate * rate) + since * (up - 0.5 * kPullOnWalls * since), 1e-14);
}

// A floor that tilts at ω about the foot of a box: its middle, h above, needs ω² h of the normal force less.
// It slides from where sin θ = μ (cos θ − ω² h / g) on, by the equation of its way along the floor: 1.2e-5 m
// off after 36 mm, as its corners reach their cones one by one, in time steps of 1e-6 m.
TEST(ExactWorldWallCourse, aTiltingFloorLetsGo) {
  World world = pulledDown();
  const double mu = 0.5;
  const double omega = 0.3;
  const double h = 0.1;
  world.walls = {movingWall(Vec3::UnitZ(), Vec3::Zero(), {.path = {}, .angularVelocity = Vec3(0, omega, 0)},
                            {.friction = mu})};
  world.bodies = {load(Vec3(0, 0, h), mu, 0, Vec3(0.2, 0.2, h))};
  BodyState& turning = world.bodies[0].initial;  // as the floor does
  turning.velocity = Vec3(omega * h, 0, 0);
  turning.angularMomentum =
      angularMomentum(world.bodies[0].mass, turning.pose.worldFromBody, Vec3(0, omega, 0));
  const Recorded run = runFor(world, 2);
  double angle = std::atan(mu);
  for (int k = 0; k < 60; ++k) {
    angle = std::asin(mu * (std::cos(angle) - omega * omega * h / kPullOnWalls));
  }
  const double slides = angle / omega;
  const auto along = [&](double time) {
    return run.at(world, 0, time).pose.position.dot(Vec3(std::cos(omega * time), 0, -std::sin(omega * time)));
  };
  EXPECT_NEAR(along(slides), 0, 2e-7);
  // s'' = g sin θ + s ω² − μ (g cos θ − 2 ω s' − ω² h)
  constexpr double kStep = 1e-5;
  double s = 0;
  double v = 0;
  const auto rate = [&](double time, double at, double speed) {
    const double theta = omega * time;
    return kPullOnWalls * std::sin(theta) + at * omega * omega -
           mu * (kPullOnWalls * std::cos(theta) - 2 * omega * speed - omega * omega * h);
  };
  for (int k = 0; k < 40'000; ++k) {
    const double time = slides + k * kStep;
    const double first = rate(time, s, v);
    const double middle = rate(time + 0.5 * kStep, s + 0.5 * kStep * v, v + 0.5 * kStep * first);
    s += kStep * (v + 0.5 * kStep * first);
    v += kStep * middle;
  }
  EXPECT_GT(s, 0.01);
  EXPECT_NEAR(along(slides + 0.4), s, 2.5e-5);
}

// A wall that pushes against friction moves its box at its own speed.
TEST(ExactWorldWallCourse, aPressPushes) {
  World world = pulledDown();
  world.walls = {wall("floor", Vec3::UnitZ(), 0, 0),
                 movingWall(Vec3::UnitX(), Vec3(-1, 0, 0), {.path = {}, .velocity = Vec3(0.5, 0, 0)})};
  world.walls[0].material.friction = 0.4;
  world.bodies = {load(Vec3(0, 0, 0.1), 0.4)};
  const Recorded run = runFor(world, 3);
  ASSERT_GE(run.impacts.size(), 1U);
  EXPECT_NEAR(run.impacts[0].time, 1.8, 1e-14);
  const BodyState end = run.last(world, 0, 3);
  EXPECT_NEAR(end.pose.position.x(), 0.6, 1e-14);
  EXPECT_NEAR(end.velocity.x(), 0.5, 1e-14);
  EXPECT_NEAR(end.pose.position.z(), 0.1, 1e-14);
}

// A floor that stops lets what stands on it fly, and where it is still what fell back rests.
TEST(ExactWorldWallCourse, aFloorThatStopsThrows) {
  World world = pulledDown();
  world.walls = {movingWall(Vec3::UnitZ(), Vec3::Zero(),
                            {.path = {{0.5, Vec3(0, 0, 0)}, {1.5, Vec3(0, 0, 1)}}}, {.friction = 0.5})};
  world.bodies = {load(Vec3(0, 0, 0.1), 0.5)};
  const Recorded run = runFor(world, 3);
  EXPECT_NEAR(run.at(world, 0, 1).pose.position.z(), 0.6, 1e-14);
  EXPECT_NEAR(run.at(world, 0, 1.6).pose.position.z(), 1.1 + 0.1 - 0.5 * kPullOnWalls * 0.01, 1e-14);
  EXPECT_NEAR(run.impacts.back().time, 1.5 + 2 / kPullOnWalls, 1e-14);
  EXPECT_NEAR(run.last(world, 0, 3).pose.position.z(), 1.1, 1e-14);
  EXPECT_TRUE(std::holds_alternative<Rest>(run.motions[0].back().second));
}

// Beside a wall that moves far away a box comes to rest; when the wall comes, it goes along.
TEST(ExactWorldWallCourse, whatRestsIsMetByAWallThatComes) {
  for (const bool crowds : {false, true}) {
    World world = pulledDown();
    world.walls = {wall("floor", Vec3::UnitZ(), 0, 0),
                   movingWall(-Vec3::UnitX(), Vec3(3, 0, 0),
                              {.path = {}, .amplitude = Vec3(2.9, 0, 0), .rate = kHalfTurn / 4})};
    world.walls[0].material.friction = 0.5;
    world.bodies = {load(Vec3(0, 0, 0.3), 0.5),
                    load(Vec3(-0.05, 0.02, 0.55), 0.5, 0, Vec3::Constant(0.1), "upper")};
    const Recorded run = crowds ? runInCrowd(world, 6) : runFor(world, 6);
    const auto isAtRest = [&](double time) {
      const auto next = std::upper_bound(run.motions[0].begin() + 1, run.motions[0].end(), time,
                                         [](double moment, const auto& each) { return moment < each.first; });
      return std::holds_alternative<Rest>((next - 1)->second);
    };
    EXPECT_TRUE(isAtRest(3)) << crowds;
    // It comes to 0.1 at 6 s.
    EXPECT_NEAR(run.last(world, 0, 6).pose.position.x(), 0, 2e-5) << crowds;
  }
}

// A whole scene in a frame that moves evenly: on a floor that is still, and on one that moves. Of 30 tosses
// the first impacts differ by 2.4e-14 m; after up to 120 impacts, with contact to 1e-6 m between them, which
// grow in tosses, half of them by less than 2e-7 m and all by less than 8.4e-4 m.
TEST(ExactWorldWallCourse, aFrameThatMovesEvenlyIsAsGoodAsAnother) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  double worst = 0;
  std::vector<double> late;
  for (int toss = 0; toss < 30; ++toss) {
    const Vec3 frame(any(random), any(random), any(random));
    const Vec3 normal = Vec3(0.3 * any(random), 0.3 * any(random), 1).normalized();
    World still = pulledDown();
    still.walls = {wall("floor", normal, 0, 0.3)};
    still.walls[0].material.friction = 0.4;
    still.bodies = {load(Vec3(0, 0, 0.5), 0.4)};
    Body& tossed = still.bodies[0];
    tossed.initial.velocity = Vec3(any(random), any(random), any(random));
    tossed.initial.angularMomentum =
        angularMomentum(tossed.mass, Mat3::Identity(), 3 * Vec3(any(random), any(random), any(random)));
    World moving = still;
    moving.walls[0] =
        movingWall(normal, Vec3::Zero(), {.path = {}, .velocity = frame}, still.walls[0].material);
    moving.bodies[0].initial.velocity += frame;
    const Recorded a = runFor(still, 0.8);
    const Recorded b = runFor(moving, 0.8);
    const auto apart = [&](double time) {
      return (b.at(moving, 0, time).pose.position - a.at(still, 0, time).pose.position - time * frame).norm();
    };
    worst = std::max(worst, apart(0.4));
    late.push_back(apart(0.8));
  }
  EXPECT_LT(worst, 5e-14);
  std::sort(late.begin(), late.end());
  EXPECT_LT(late[15], 5e-7);
  EXPECT_LT(late.back(), 2e-3);
}

// The same scene with a wall, and with a fixed box of 20 m that has it for a face: walls that swing, turn and
// go on, and boxes that were tossed on them. Impacts are at the same times to 1e-13 s; of 24 tosses 23 differ
// by less than 2.4e-8 m at 0.4 s, and half of them by less than 3e-5 m at 0.7 s.
TEST(ExactWorldWallCourse, aWallIsABoxWithoutEnd) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<double> early;
  std::vector<double> late;
  for (int toss = 0; toss < 24; ++toss) {
    const Vec3 normal = Vec3(0.3 * any(random), 0.3 * any(random), 1).normalized();
    const Vec3 axis = Vec3(any(random), any(random), any(random));
    const PrescribedMotion motion{.path = {},
                                  .velocity = 0.3 * Vec3(any(random), any(random), any(random)),
                                  .angularVelocity = (toss % 3 == 0 ? 0.0 : 0.3) * axis,
                                  .about = Vec3(any(random), any(random), any(random)),
                                  .amplitude = 0.05 * Vec3(any(random), any(random), any(random)),
                                  .swing = (toss % 2 == 0 ? 0.0 : 0.1) * axis,
                                  .rate = 9};
    World walled = pulledDown();
    walled.walls = {movingWall(normal, Vec3::Zero(), motion, {.restitution = 0.3, .friction = 0.4})};
    walled.bodies = {load(Vec3(0, 0, 0.5), 0.4)};
    Body& tossed = walled.bodies[0];
    tossed.initial.velocity = Vec3(any(random), any(random), any(random));
    tossed.initial.angularMomentum =
        angularMomentum(tossed.mass, Mat3::Identity(), 3 * Vec3(any(random), any(random), any(random)));
    World boxed = walled;
    boxed.walls.clear();
    boxed.bodies.push_back(boxBehind(walled.walls[0], motion, Vec3::Zero(), 10));
    const Recorded a = runFor(walled, 0.7);
    const Recorded b = runFor(boxed, 0.7);
    const auto apart = [&](double time) {
      return (b.at(boxed, 0, time).pose.position - a.at(walled, 0, time).pose.position).norm();
    };
    early.push_back(apart(0.4));
    late.push_back(apart(0.7));
    ASSERT_FALSE(a.impacts.empty()) << toss;
    EXPECT_NEAR(a.impacts[0].time, b.impacts[0].time, 1e-13) << toss;
  }
  std::sort(early.begin(), early.end());
  std::sort(late.begin(), late.end());
  EXPECT_LT(early[12], 1e-13);
  EXPECT_LT(early[22], 5e-8);
  EXPECT_LT(late[12], 1e-4);
  EXPECT_LT(late.back(), 5e-3);
}

// As a crowd.
TEST(ExactWorldWallCourse, crowdsAreCarriedByWalls) {
  World world = pulledDown();
  world.walls = {movingWall(Vec3::UnitZ(), Vec3::Zero(),
                            {.path = {}, .amplitude = Vec3(0, 0, 0.3), .rate = kHalfTurn},
                            {.friction = 0.5})};
  for (int k = 0; k < 9; ++k) {
    world.bodies.push_back(load(Vec3(0.3 * (k % 3), 0.3 * (k / 3), 0.1), 0.5, 0, Vec3::Constant(0.1),
                                "load" + std::to_string(k)));
  }
  const Recorded run = runInCrowd(world, 3);
  for (std::size_t k = 0; k < world.bodies.size(); ++k) {
    EXPECT_NEAR(run.last(world, k, 3).pose.position.z(), 0.1 + 0.3 * std::sin(3 * kHalfTurn), 1e-6);
    EXPECT_NEAR(run.at(world, k, 1.25).pose.position.z(), 0.1 + 0.3 * std::sin(1.25 * kHalfTurn), 2e-5);
  }
}

// A tilting floor under a crowd: as long as friction holds, all turn with it.
TEST(ExactWorldWallCourse, crowdsTurnWithAWall) {
  World world = pulledDown();
  const double omega = 0.3;
  world.walls = {movingWall(Vec3::UnitZ(), Vec3::Zero(), {.path = {}, .angularVelocity = Vec3(0, omega, 0)},
                            {.friction = 0.9})};
  for (int k = 0; k < 9; ++k) {
    world.bodies.push_back(load(Vec3(0.5 * (k % 3) - 0.5, 0.5 * (k / 3), 0.1), 0.9, 0, Vec3(0.2, 0.2, 0.1),
                                "load" + std::to_string(k)));
  }
  const Recorded run = runInCrowd(world, 2);
  double worst = 0;
  const double angle = 2 * omega;
  for (std::size_t k = 0; k < world.bodies.size(); ++k) {
    const Vec3& from = world.bodies[k].initial.pose.position;
    const Vec3 to(std::cos(angle) * from.x() + std::sin(angle) * from.z(), from.y(),
                  std::cos(angle) * from.z() - std::sin(angle) * from.x());
    worst = std::max(worst, (run.last(world, k, 2).pose.position - to).norm());
  }
  EXPECT_LT(worst, 1e-3);
}

}  // namespace
}  // namespace careen
