// Surfaces that move along themselves, against closed forms and by the frame that moves with them: errors
// beside what was measured, at a tolerance of 1e-6.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <variant>
#include <vector>

#include "support/exact_runs.h"

namespace careen {
namespace {

constexpr double kPullOfBelts = 9.81;
constexpr double kRough = 0.3;

Body onBelt(const std::string& name, const Vec3& position, const Vec3& velocity = Vec3::Zero(),
            const Vec3& spin = Vec3::Zero()) {
  Body body = box(name, Vec3::Constant(0.1), 1, position, velocity, spin, 0);
  body.material.friction = kRough;
  return body;
}

World onFloorThatMoves(const SurfaceMotion& surface) {
  World world;
  world.gravity = Vec3(0, 0, -kPullOfBelts);
  world.walls = {wall("belt", Vec3::UnitZ(), 0, 0)};
  world.walls[0].material = {.friction = kRough, .surface = surface};
  return world;
}

SurfaceMotion belt(const Vec3& velocity) { return {.velocity = velocity}; }
SurfaceMotion turntable(double spin) { return {.spin = Vec3(0, 0, spin)}; }

// It slips for v/(μg) and v²/(2μg), and then rides. 7e-11 m off after 3 s.
TEST(ExactWorldBelt, whatIsPutOnABeltSlipsAndThenRides) {
  const double speed = 1.5;
  World world = onFloorThatMoves(belt(Vec3(speed, 0, 0)));
  world.bodies = {onBelt("box", Vec3(0, 0, 0.1))};
  const Recorded run = runFor(world, 3);
  const double slips = speed / (kRough * kPullOfBelts);
  const BodyState end = run.last(world, 0, 3);
  EXPECT_NEAR(run.at(world, 0, 0.5 * slips).velocity.x(), 0.5 * speed, 2e-10);
  EXPECT_NEAR(end.pose.position.x(), 0.5 * speed * slips + speed * (3 - slips), 2e-10);
  EXPECT_NEAR(end.velocity.x(), speed, 1e-14);
  EXPECT_LT(end.angularMomentum.norm(), 1e-14);
}

// A box stays on a turntable where μg carries it round, and leaves it where it does not: at .5 m 2 and 3.38
// m/s² of 2.943. 2e-7 m off after 6 s.
TEST(ExactWorldBelt, aTurntableCarriesWhatFrictionHolds) {
  for (const double spin : {2.0, 2.6}) {
    World world = onFloorThatMoves(turntable(spin));
    world.bodies = {onBelt("box", Vec3(0.5, 0, 0.1), Vec3(0, 0.5 * spin, 0), Vec3(0, 0, spin))};
    const Recorded run = runFor(world, 6);
    const Vec3 end = run.last(world, 0, 6).pose.position;
    if (spin * spin * 0.5 < kRough * kPullOfBelts) {
      EXPECT_NEAR(std::hypot(end.x(), end.y()), 0.5, 4e-7);
      EXPECT_NEAR(std::remainder(std::atan2(end.y(), end.x()) - 6 * spin, 2 * 3.14159265358979324), 0, 4e-7);
    } else {
      EXPECT_GT(std::hypot(end.x(), end.y()), 5);
    }
  }
}

// Seen from a belt everything is as on a floor that is still: at moments of 40 tosses 8e-6 m off at the most,
// as the tolerance of 1e-6 m grows in tosses.
TEST(ExactWorldBelt, isAFloorInTheFrameThatMovesWithIt) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int toss = 0; toss < 40; ++toss) {
    const Vec3 along(any(random), any(random), 0);
    World still = onFloorThatMoves({});
    still.walls[0].material.restitution = 0.3;
    still.bodies = {onBelt("box", Vec3(0, 0, 0.3), Vec3(any(random), any(random), any(random)),
                           Vec3(any(random), any(random), any(random)) * 3)};
    World moving = still;
    moving.walls[0].material.surface = belt(along);
    moving.bodies[0].initial.velocity += along;
    const Recorded a = runFor(still, 0.7);
    const Recorded b = runFor(moving, 0.7);
    for (const double time : {0.2, 0.35, 0.5, 0.7}) {
      const BodyState expected = a.at(still, 0, time);
      const BodyState found = b.at(moving, 0, time);
      EXPECT_LT((found.pose.position - expected.pose.position - time * along).norm(), 1e-5) << toss;
      EXPECT_LT((found.pose.worldFromBody - expected.pose.worldFromBody).norm(), 1e-4) << toss;
    }
  }
}

// The faces of a fixed box move along themselves, each by what is along it: on the top a box rides, at the
// end face another falls as if nothing moved.
TEST(ExactWorldBelt, fixedBoxesAreBeltsOnEachFace) {
  World world;
  world.gravity = Vec3(0, 0, -kPullOfBelts);
  Body conveyor = onBelt("conveyor", Vec3(0, 0, -0.5));
  conveyor.halfExtents = Vec3(2, 0.5, 0.5);
  conveyor.mass = immovable();
  conveyor.material.surface = belt(Vec3(1, 0, 0));
  world.bodies = {conveyor, onBelt("rides", Vec3(-1, 0, 0.1)), onBelt("falls", Vec3(2.1, 0, -0.2))};
  const Recorded run = runFor(world, 0.5);
  const double slips = 1 / (kRough * kPullOfBelts);
  EXPECT_NEAR(run.last(world, 1, 0.5).pose.position.x(), -1 + 0.5 * slips + (0.5 - slips), 2e-10);
  EXPECT_NEAR(run.last(world, 2, 0.5).pose.position.z(), -0.2 - 0.5 * kPullOfBelts * 0.25, 1e-12);
}

// A plate on a turntable that is smaller than it: what touches are the corners of what is held. 1e-7 m off.
TEST(ExactWorldBelt, aSmallTurntableCarriesAPlate) {
  World world;
  world.gravity = Vec3(0, 0, -kPullOfBelts);
  Body table = onBelt("table", Vec3::Zero());
  table.mass = immovable();
  table.material = {.friction = 1, .surface = turntable(2)};
  Body plate = box("plate", Vec3(0.5, 0.4, 0.05), 2, Vec3(0.05, 0, 0.15), Vec3(0, 0.1, 0), Vec3(0, 0, 2), 0);
  plate.material.friction = 1;
  world.bodies = {table, plate};
  const Vec3 end = runFor(world, 5).last(world, 1, 5).pose.position;
  EXPECT_NEAR(end.x(), 0.05 * std::cos(10.0), 2e-7);
  EXPECT_NEAR(end.y(), 0.05 * std::sin(10.0), 2e-7);
}

// As a crowd: 1e-6 m off after 3 s on a belt; on a turntable 11 mm at .9 m after two turns, of
// second order in steps.
TEST(ExactWorldBelt, crowdsRideToo) {
  const double speed = 1.5;
  World world = onFloorThatMoves(belt(Vec3(speed, 0, 0)));
  for (int k = 0; k < 20; ++k) {
    world.bodies.push_back(onBelt("box" + std::to_string(k), Vec3(0.25 * k, 0, 0.1)));
  }
  const Recorded run = runInCrowd(world, 3);
  const double slips = speed / (kRough * kPullOfBelts);
  for (std::size_t k = 0; k < world.bodies.size(); ++k) {
    EXPECT_NEAR(run.last(world, k, 3).pose.position.x() - world.bodies[k].initial.pose.position.x(),
                0.5 * speed * slips + speed * (3 - slips), 2e-6);
  }
  World turning = onFloorThatMoves(turntable(2));
  for (int k = 0; k < 20; ++k) {
    const double angle = 0.314159265 * k;
    turning.bodies.push_back(onBelt("box" + std::to_string(k),
                                    Vec3(0.9 * std::cos(angle), 0.9 * std::sin(angle), 0.1),
                                    1.8 * Vec3(-std::sin(angle), std::cos(angle), 0), Vec3(0, 0, 2)));
    turning.bodies.back().material.friction = 2;
  }
  const Recorded round = runInCrowd(turning, 6);
  for (std::size_t k = 0; k < turning.bodies.size(); ++k) {
    const Vec3 end = round.last(turning, k, 6).pose.position;
    EXPECT_NEAR(std::hypot(end.x(), end.y()), 0.9, 0.02);
  }
}

// Crowds bounce on a belt as on a floor in its frame: velocities are 2e-15 m/s off.
TEST(ExactWorldBelt, crowdsBounceOnIt) {
  const Vec3 along(2, -1, 0);
  World still = onFloorThatMoves({});
  still.walls[0].material.restitution = 0.6;
  for (int k = 0; k < 8; ++k) {
    still.bodies.push_back(onBelt("box" + std::to_string(k), Vec3(k, 0, 0.3), Vec3(0.3 * k - 1, 0.4, 0.2)));
  }
  World moving = still;
  moving.walls[0].material.surface = belt(along);
  for (Body& body : moving.bodies) {
    body.initial.velocity += along;
  }
  const Recorded a = runInCrowd(still, 0.4);
  const Recorded b = runInCrowd(moving, 0.4);
  for (std::size_t k = 0; k < still.bodies.size(); ++k) {
    const Vec3 due = a.last(still, k, 0.4).velocity + along;
    const Vec3 found = b.last(moving, k, 0.4).velocity;
    EXPECT_LT(std::hypot(found.x() - due.x(), found.y() - due.y()), 1e-13) << k;
    EXPECT_NEAR(found.z(), due.z(), 1e-13) << k;
  }
}

// It is pushed sideways as it lands, by no more than friction: μ times what gravity and the fall gave it.
TEST(ExactWorldBelt, impactsAimAtIt) {
  World world = onFloorThatMoves(belt(Vec3(5, 0, 0)));
  world.bodies = {onBelt("box", Vec3(0, 0, 0.6))};
  const Recorded run = runFor(world, 1);
  ASSERT_FALSE(run.impacts.empty());
  double normal = 0;
  double along = 0;
  for (const Impact& impact : run.impacts) {
    const bool isFirst = impact.time == run.impacts[0].time;
    normal += isFirst ? impact.impulse : 0;
    along += isFirst ? impact.tangential : 0;
  }
  EXPECT_NEAR(normal, std::sqrt(2 * kPullOfBelts * 0.5), 1e-12);
  EXPECT_NEAR(along, kRough * normal, 1e-12);
  const double landed = std::sqrt(2 * 0.5 / kPullOfBelts);
  EXPECT_NEAR(run.at(world, 0, landed + 1e-9).velocity.x(), kRough * normal, 1e-8);
}

}  // namespace
}  // namespace careen
