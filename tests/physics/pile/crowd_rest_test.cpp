// When members of a crowd fall asleep, what they do then, and what wakes them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "physics/pile/crowd.h"
#include "physics/world/diagnostics.h"
#include "support/crates.h"
#include "support/crowd_run.h"
#include "support/pile_scenes.h"

namespace careen {
namespace {

using namespace test;

TEST(CrowdRest, droppedBoxComesToRestOnTheFloorAndSleeps) {
  for (const double restitution : {0.0, 0.5}) {
    const Material material{.restitution = restitution, .friction = 0.5};
    World world = floorWorld(material);
    world.bodies.push_back(crate("a", Vec3(0.25, 0.2, 0.3), Vec3(0, 0, 1.3), material));
    test::CrowdRun crowd(world);
    int frames = 0;
    for (; frames < 300 && !crowd.atRest(); ++frames) {
      crowd.step();
    }
    EXPECT_LT(frames, 240) << restitution;
    EXPECT_TRUE(crowd.sleeps(0));
    EXPECT_NEAR(crowd.states()[0].pose.position.z(), 0.3, 1e-4);
    EXPECT_NEAR(crowd.states()[0].pose.worldFromBody(2, 2), 1, 1e-6);
  }
}

TEST(CrowdRest, frozenCrowdIsConstantToTheBitCostsNothingAndWakesWhenHit) {
  const Material material{.restitution = 0, .friction = 0.5};
  World world = floorWorld(material);
  for (int k = 0; k < 3; ++k) {
    world.bodies.push_back(
        crate("stack" + std::to_string(k), Vec3::Constant(0.25), Vec3(0, 0, 0.25 + 0.5 * k), material));
  }
  // Arrives after 1.4 s.
  world.bodies.push_back(crate("late", Vec3::Constant(0.2), Vec3(0.1, 0.05, 11), material));
  test::CrowdRun crowd(world);
  for (int frame = 0; frame < 30; ++frame) {
    crowd.step();
  }
  ASSERT_TRUE(crowd.sleeps(0) && crowd.sleeps(1) && crowd.sleeps(2));
  EXPECT_FALSE(crowd.sleeps(3));
  const std::vector<BodyState> frozen(crowd.states().begin(), crowd.states().end());
  const std::int64_t rows = crowd.figures().rows;
  for (int frame = 0; frame < 30; ++frame) {
    crowd.step();
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_TRUE(sameBits(crowd.states()[k], frozen[k])) << frame;
    }
  }
  EXPECT_EQ(crowd.figures().rows, rows);
  bool woke = false;
  for (int frame = 0; frame < 240; ++frame) {
    crowd.step();
    woke = woke || !crowd.sleeps(0);
  }
  EXPECT_TRUE(woke);
  EXPECT_TRUE(crowd.atRest());
}

// Two courses of bricks, in contact all along; on the first one a box that a spring keeps moving.
TEST(CrowdRest, oneRestlessBodyKeepsOnlyItsNeighboursAwake) {
  const Material material{.restitution = 0, .friction = 0.5};
  World world = floorWorld(material);
  const double pitch = 0.52;
  for (int k = 0; k < 10; ++k) {
    world.bodies.push_back(
        crate("low" + std::to_string(k), Vec3::Constant(0.25), Vec3(k * pitch, 0, 0.25), material));
  }
  for (int k = 0; k < 9; ++k) {
    world.bodies.push_back(
        crate("up" + std::to_string(k), Vec3::Constant(0.25), Vec3((k + 0.5) * pitch, 0, 0.75), material));
  }
  Body restless = crate("restless", Vec3::Constant(0.1), Vec3(0.5 * pitch + 0.1, 0, 1.1), {});
  restless.mass = solidBox(restless.halfExtents, 4);
  world.bodies.push_back(restless);
  world.springs.push_back(
      {.from = {.body = 19}, .to = {.body = {}, .point = Vec3(0.5 * pitch, 0, 1.1)}, .stiffness = 100});
  // Arrives after 2.2 s.
  world.bodies.push_back(crate("late", Vec3::Constant(0.25), Vec3(8.5 * pitch, 0.05, 25), material));
  test::CrowdRun crowd(world);
  for (int frame = 0; frame < 60; ++frame) {
    crowd.step();
  }
  EXPECT_FALSE(crowd.sleeps(19));
  EXPECT_FALSE(crowd.sleeps(10));  // carries it
  ASSERT_TRUE(crowd.sleeps(9) && crowd.sleeps(18));
  int asleep = 0;
  for (int frame = 0; frame < 60; ++frame) {
    crowd.step();
    asleep += crowd.sleeps(9) && crowd.sleeps(18) ? 1 : 0;
  }
  EXPECT_GT(asleep, 30);  // never, if all in contact must be quiet
  EXPECT_FALSE(crowd.sleeps(19));
  RecordProperty("asleep", asleep);
  // It still swings, and what sleeps carries what is awake.
  for (std::size_t k = 0; k < 19; ++k) {
    EXPECT_LT((crowd.states()[k].pose.position - world.bodies[k].initial.pose.position).norm(), 1e-3) << k;
  }
  bool woke = false;
  for (int frame = 0; frame < 60; ++frame) {
    crowd.step();
    woke = woke || (!crowd.sleeps(18) && !crowd.sleeps(9));
  }
  EXPECT_TRUE(woke);
}

// One that nearly touches a box asleep, and that another throws against it: what sleeps takes the momentum.
TEST(CrowdRest, boxThatIsStruckInItsSleepByOneBesideItTakesTheMomentum) {
  const Material smooth{.restitution = 0, .friction = 0.001};
  World world = floorWorld(smooth);
  const Vec3 half = Vec3::Constant(0.25);
  world.bodies.push_back(crate("asleep", half, Vec3(0, 0, 0.25), smooth));
  // Slides by 1 mm in 0.1 s and stops at some 3 mm from it, then is thrown against it.
  world.bodies.push_back(crate("beside", half, Vec3(0.503, 0, 0.25), smooth));
  world.bodies.push_back(crate("thrown", half, Vec3(3.0, 0, 0.25), smooth));
  world.bodies[2].initial.velocity = Vec3(-4, 0, 0);
  world.bodies[1].initial.velocity = Vec3(0, 0.3, 0);
  test::CrowdRun crowd(world);
  double least = 0;
  for (int frame = 0; frame < 60; ++frame) {
    crowd.step();
    least = std::min(least, linearMomentum(world, crowd.states()).x());
  }
  RecordProperty("momentum", std::to_string(linearMomentum(world, crowd.states()).x()));
  EXPECT_LT(linearMomentum(world, crowd.states()).x(), 0.97 * least);
}

// Forces on a slope that is steeper by so little than friction holds all but balance: the block begins so
// slowly that only the certificate of rest tells it from one that stands.
TEST(CrowdRest, blockThatBeginsToSlideIsNotTakenForOneAtRest) {
  const double friction = 0.4;
  for (const double steeper : {-0.003, 0.003}) {
    World world = floorWorld({.restitution = 0, .friction = friction});
    const double tangent = friction + steeper;
    const double cosine = 1 / std::sqrt(1 + tangent * tangent);
    world.gravity = kGravity * cosine * Vec3(tangent, 0, -1);
    world.bodies.push_back(crate("a", Vec3(0.3, 0.3, 0.1), Vec3(0, 0, 0.1), {.friction = friction}));
    test::CrowdRun crowd(world);
    for (int k = 0; k < 120; ++k) {
      crowd.step();
    }
    const double way = 0.5 * kGravity * cosine * std::max(0.0, steeper) * 2 * 2;
    EXPECT_NEAR(crowd.states()[0].pose.position.x(), way, 0.05 * way + 1e-6) << steeper;
    EXPECT_EQ(crowd.sleeps(0), steeper < 0);
  }
}

// What sleeps keeps the impulses of the step in which it fell asleep: those of steps that follow, of other
// lengths, have no part in them. Else a heap that is struck after short steps jumps.
TEST(CrowdRest, heapThatIsStruckAfterShortStepsGainsNoEnergy) {
  World world = pouring(300, 0.5, 0, 1, 4);
  world.bodies.push_back(crate("late", Vec3::Constant(0.25), Vec3::Zero(), {.friction = 0.5}));
  const std::size_t late = world.bodies.size() - 1;
  const std::size_t walls = world.walls.size();  // their places come first
  Crowd crowd(world, Crowd::kUsualTolerance);
  for (std::size_t i = 0; i < late; ++i) {
    const BodyState& state = world.bodies[i].initial;
    crowd.admit(i, state, Quat(state.pose.worldFromBody).normalized());
  }
  double usual = 0;
  for (double time = 0; time < 20 && !crowd.atRest(); time += usual) {
    usual = crowd.step(1);
  }
  ASSERT_TRUE(crowd.atRest());
  BodyState thrown;
  for (std::size_t i = 0; i < late; ++i) {
    thrown.pose.position.z() = std::max(thrown.pose.position.z(), crowd.state(walls + i).pose.position.z());
  }
  thrown.pose.position.z() += 1;
  thrown.velocity = Vec3(0, 0, -3);
  crowd.admit(late, thrown, Quat::Identity());
  const double ofTheBlow = 0.5 * world.bodies[late].mass.mass * thrown.velocity.squaredNorm();
  double lowest = std::numeric_limits<double>::max();
  double rise = 0;
  int woken = 0;
  std::vector<char> slept(late + 1, 0);
  for (int step = 0; step < 300; ++step) {
    crowd.step(step % 3 == 2 ? usual : usual / 8);
    std::vector<BodyState> states;
    for (std::size_t i = 0; i <= late; ++i) {
      const bool sleeps = crowd.sleeps(walls + i);
      woken += slept[i] != 0 && !sleeps ? 1 : 0;
      slept[i] = sleeps ? 1 : 0;
      states.push_back(crowd.stateAtVelocity(walls + i));
    }
    const double energy = energyOf(world, states).total();
    lowest = std::min(lowest, energy);
    rise = std::max(rise, energy - lowest);
  }
  RecordProperty("rise", std::to_string(rise / ofTheBlow));
  EXPECT_GT(woken, 100);
  EXPECT_LT(rise, 0.01 * ofTheBlow);  // measured 0; 0.11 with impulses scaled by each step
}

TEST(CrowdRest, stackOfTenStands) {
  const Material material{.restitution = 0, .friction = 0.5};
  World world = floorWorld(material);
  for (int k = 0; k < 10; ++k) {
    world.bodies.push_back(crate("box" + std::to_string(k), Vec3::Constant(0.25),
                                 Vec3(0.01 * (k % 3), -0.01 * (k % 2), 0.25 + 0.5 * k), material));
  }
  test::CrowdRun crowd(world);
  for (int frame = 0; frame < 600; ++frame) {
    crowd.step();
  }
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_LT((crowd.states()[k].pose.position - world.bodies[k].initial.pose.position).norm(), 2e-3) << k;
  }
  EXPECT_TRUE(crowd.atRest());
}

}  // namespace
}  // namespace careen
