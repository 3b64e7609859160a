#include "trajectory/energy_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/jointed.h"
#include "trajectory/export_csv.h"

namespace careen {
namespace {

constexpr double kPull = 10;  // [m/s²]

World fallingDie(const Vec3& position, const Vec3& velocity = Vec3::Zero()) {
  World world;
  world.gravity = Vec3(0, 0, -kPull);
  world.bodies = {box("die", Vec3::Constant(0.5), 2, position, velocity, Vec3::Zero(), 0)};
  return world;
}

// 2 kg at 3 m: ½ m v² of v = g t, and m g h of the rest of its height; p and x × p.
TEST(EnergySamples, ofAFreeFall) {
  const Trajectory run = record(fallingDie(Vec3(4, 0, 3), Vec3(0, 1, 0)), {.duration = 0.5}, "");
  EnergySamples samples(run);
  for (const double time : {0.0, 0.125, 0.3, 0.5}) {
    const RunEnergies now = samples.at(time);
    const double speed = kPull * time;
    const double height = 3 - 0.5 * kPull * time * time;
    EXPECT_NEAR(now.shares.translation, 0.5 * 2 * (1 + speed * speed), 1e-12);
    EXPECT_EQ(now.shares.rotation, 0);
    EXPECT_NEAR(now.shares.gravity, 2 * kPull * height, 1e-12);
    EXPECT_NEAR(now.shares.sum(), 61, 1e-12);
    EXPECT_NEAR(now.remaining, 0, 1e-12);
    EXPECT_LT((now.momentum - Vec3(0, 2, -2 * speed)).norm(), 1e-12);
    // (4, t, height) × (0, 2, −2 g t)
    EXPECT_LT((now.angularMomentum - Vec3(-2 * speed * time - 2 * height, 8 * speed, 8)).norm(), 1e-12);
  }
}

// It falls 1 m: the impact takes (1 − e²)/2 m v² = (1 − e²) m g · 1 m.
TEST(EnergySamples, aBounceLosesWhatRestitutionSays) {
  for (const double restitution : {1.0, 0.5, 0.0}) {
    World world = fallingDie(Vec3(0, 0, 1.5));
    world.walls = {wall("floor", Vec3::UnitZ(), 0, restitution)};
    const Trajectory run = record(world, {.duration = 0.6}, "");
    EnergySamples samples(run);
    EXPECT_EQ(samples.at(0.44).lost.impacts, 0);  // √0.2 = 0.447
    const RunEnergies after = samples.at(0.6);
    const double lost = (1 - restitution * restitution) * 2 * kPull;
    EXPECT_NEAR(after.lost.impacts, lost, 1e-11);
    EXPECT_NEAR(after.shares.sum(), 30 - lost, 1e-11);
    EXPECT_NEAR(after.remaining, 0, 1e-11);
  }
}

// It stops after v²/(2 μ g) = 0.8 m, and μ m g · 0.8 m = ½ m v².
TEST(EnergySamples, slidingIsWhatRemains) {
  World world = fallingDie(Vec3(0, 0, 0.5), Vec3(2, 0, 0));
  world.bodies[0].material.friction = 0.25;
  world.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
  world.walls[0].material.friction = 0.25;
  const Trajectory run = record(world, {.duration = 1}, "");
  EnergySamples samples(run);
  for (const double time : {0.25, 0.5, 0.75, 1.0}) {
    const RunEnergies now = samples.at(time);
    const double until = std::min(time, 0.8);
    const double way = 2 * until - 0.5 * 2.5 * until * until;
    EXPECT_NEAR(now.remaining, 0.25 * 2 * kPull * way, 1e-6);
    EXPECT_NEAR(now.lost.sum(), 0, 1e-10);
  }
}

// 2 kg at 1 m from where a spring of 8 N/m rests, damped by c: x'' = −(c/m) x' − (k/m) x.
double placeOf(double time, double damping) {
  const double decay = damping / 4;
  const double rate = std::sqrt(4 - decay * decay);
  return std::exp(-decay * time) * (std::cos(rate * time) + decay / rate * std::sin(rate * time));
}
double speedOf(double time, double damping) {
  const double decay = damping / 4;
  const double rate = std::sqrt(4 - decay * decay);
  return -4 / rate * std::exp(-decay * time) * std::sin(rate * time);
}
// By a spring of the scene, and by one of a slider.
World oscillator(double damping, bool byJoint) {
  World world;
  world.bodies = {box("bob", Vec3::Constant(0.1), 2, Vec3(1, 0, 0))};
  if (byJoint) {
    Joint& rail = test::join(world, Joint::Kind::kSlider, 0, {}, Vec3(1, 0, 0), Vec3::UnitX());
    rail.stiffness = 8;
    rail.rest = -1;  // its coordinate is 0 at the start
    rail.damping = damping;
  } else {
    world.springs = {{.from = {.body = 0, .point = Vec3::Zero()},
                      .to = {.body = {}, .point = Vec3(-3, 0, 0)},
                      .stiffness = 8,
                      .damping = damping,
                      .restLength = 3}};
  }
  return world;
}

TEST(EnergySamples, ofAnOscillatorWithAndWithoutDamping) {
  for (const double damping : {0.0, 0.5}) {
    for (const bool byJoint : {false, true}) {
      const Trajectory run = record(oscillator(damping, byJoint), {.duration = 4, .tolerance = 1e-9}, "");
      EnergySamples samples(run);
      for (int k = 0; k <= 16; ++k) {
        const double time = 0.25 * k;
        const RunEnergies now = samples.at(time);
        const double place = placeOf(time, damping);
        const double speed = speedOf(time, damping);
        EXPECT_NEAR(byJoint ? now.shares.jointSprings : now.shares.springs, 4 * place * place, 1e-7);
        EXPECT_EQ(byJoint ? now.shares.springs : now.shares.jointSprings, 0);
        EXPECT_NEAR(now.shares.translation, speed * speed, 1e-7);
        EXPECT_NEAR(now.lost.damping, 4 - 4 * place * place - speed * speed, 1e-7);
        EXPECT_NEAR(now.remaining, 0, 1e-7);
      }
    }
  }
}

// Undamped, x = cos 2t: after an eighth of a period it has half of the 4 J, which it takes along there.
TEST(EnergySamples, aSpringTakesItsEnergyAlongWhenItsJointLetsGo) {
  World world = oscillator(0, true);
  world.joints[0].until = M_PI / 8;
  const Trajectory run = record(world, {.duration = 1, .tolerance = 1e-9}, "");
  EnergySamples samples(run);
  EXPECT_NEAR(samples.at(0.99 * M_PI / 8).shares.jointSprings, 2, 0.1);
  for (const double time : {1.01 * M_PI / 8, 1.0}) {
    const RunEnergies freed = samples.at(time);
    EXPECT_EQ(freed.shares.jointSprings, 0);
    EXPECT_NEAR(freed.shares.translation, 2, 1e-7);
    EXPECT_NEAR(freed.remaining, 2, 1e-7);
  }
}

// A slide of 1 kg is pushed by 3 N from 0.5 s on: F x = ½ m v². One with a drive of the same force, which is
// not recorded: its work is missing in what remains.
TEST(EnergySamples, motorsGiveTheirEffortTimesTheWay) {
  Trajectory run;
  run.settings.duration = 1.5;
  run.world.bodies = {box("slide", Vec3::Constant(0.1), 1, Vec3::Zero())};
  test::join(run.world, Joint::Kind::kSlider, 0, {}, Vec3::Zero(), Vec3::UnitX());
  Flight pushed;
  pushed.acceleration = Vec3(3, 0, 0);
  run.tracks = {{.segments = {{.start = 0, .motion = Flight{}}, {.start = 0.5, .motion = pushed}}}};
  run.jointEfforts = {{.time = 0.5, .joint = 0, .effort = 3}};
  EnergySamples samples(run);
  EXPECT_EQ(samples.at(0.5).motors, 0);
  EXPECT_NEAR(samples.at(1).motors, 3 * 0.375, 1e-14);
  const RunEnergies end = samples.at(1.5);
  EXPECT_NEAR(end.motors, 4.5, 1e-14);
  EXPECT_NEAR(end.shares.translation, 4.5, 1e-14);
  EXPECT_NEAR(end.remaining, 0, 1e-14);

  run.jointEfforts.clear();
  run.world.joints[0].grip = 3;
  run.world.joints[0].keptRate = 100;
  const RunEnergies driven = EnergySamples(run).at(1.5);
  EXPECT_EQ(driven.motors, 0);
  EXPECT_NEAR(driven.remaining, -4.5, 1e-14);
}

// Nothing acts from outside: momenta of both stay, whatever the impact.
TEST(EnergySamples, aFreePairKeepsItsMomenta) {
  World world;
  world.bodies = {box("a", Vec3(0.5, 0.3, 0.2), 1, Vec3(-2, 0.3, 0.1), Vec3(3, 0, 0), Vec3(1, 2, 3), 0.5),
                  box("b", Vec3(0.2, 0.4, 0.6), 3, Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, -1, 2), 0.5)};
  const Trajectory run = record(world, {.duration = 2}, "");
  ASSERT_FALSE(run.impacts.empty());
  EnergySamples samples(run);
  const RunEnergies start = samples.at(0);
  EXPECT_LT((start.momentum - Vec3(0, 0, 0)).norm(), 1e-12);
  const RunEnergies end = samples.at(2);
  EXPECT_LT((end.momentum - start.momentum).norm(), 1e-11);
  EXPECT_LT((end.angularMomentum - start.angularMomentum).norm(), 1e-11);
  EXPECT_GT(end.lost.impacts, 0.1);
  EXPECT_NEAR(end.remaining, 0, 1e-10);
}

// 2 kg fall from 3 m under gravity that goes from 10 m/s² down to none in 1 s: z = 3 − 5 t² + 5 t³/3, and −m
// g·x = 2 (10 − 10 t) z loses 20 ∫ z dt by that until then, 20 (3 t − 5 t³/3 + 5 t⁴/12), and nothing after
// it.
TEST(EnergySamples, tellWhatSlopesOfGravityGive) {
  World world = fallingDie(Vec3(0, 0, 3));
  world.gravityChanges = {{.time = 1, .gravity = Vec3::Zero()}};
  world.gravityPath = GravityPath::kLinear;
  const Trajectory run = record(world, {.duration = 1.1}, "");
  EnergySamples samples(run);
  for (const double time : {0.3, 0.7, 1.0, 1.1}) {
    const double t = std::min(time, 1.0);
    const RunEnergies now = samples.at(time);
    EXPECT_NEAR(now.changes, -20 * (3 * t - 5 * t * t * t / 3 + 5 * t * t * t * t / 12), 1e-12) << time;
    EXPECT_NEAR(now.shares.sum() - now.changes, 60, 1e-12) << time;
    EXPECT_NEAR(now.remaining, 0, 1e-12) << time;
  }
}

// 2 kg fall from 3 m under 10 m/s² for .4 s, to 2.2 m, and go on under 5 upwards: that takes −2 (5 + 10) 2.2
// J from m g z, which is −m g·x.
TEST(EnergySamples, tellWhatChangesOfGravityGive) {
  World world = fallingDie(Vec3(0, 0, 3));
  world.gravityChanges = {{.time = 0.4, .gravity = Vec3(0, 0, 5)}};
  const Trajectory run = record(world, {.duration = 1}, "");
  EnergySamples samples(run);
  EXPECT_EQ(samples.at(0.3).changes, 0);
  for (const double time : {0.4, 0.7, 1.0}) {
    const RunEnergies now = samples.at(time);
    EXPECT_NEAR(now.changes, -66, 1e-12);
    EXPECT_NEAR(now.shares.sum() - now.changes, 60, 1e-12);
    EXPECT_NEAR(now.remaining, 0, 1e-12);
  }
}

TEST(EnergySamples, writeATable) {
  World world = fallingDie(Vec3(0, 0, 1));
  world.gravity = Vec3::Zero();
  world.bodies[0].initial.velocity = Vec3(2, 0, 0);
  std::string text;
  writeEnergyCsv(record(world, {.duration = 0.5}, ""), 0.5,
                 [&text](std::string_view piece) { text += piece; });
  EXPECT_EQ(
      text,
      "time,translation,rotation,gravity,springs,joint_springs,total,motors,changes,impacts,joint_friction,"
      "damping,drag,remaining,px,py,pz,lx,ly,lz\n"
      "0,4,0,0,0,0,4,0,0,0,0,0,0,0,4,0,0,0,4,0\n"
      "0.5,4,0,0,0,0,4,0,0,0,0,0,0,0,4,0,0,0,4,0\n");
}

}  // namespace
}  // namespace careen
