#include "physics/pile/crowd_sleep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/crates.h"
#include "support/crowd_stages.h"

namespace careen {
namespace {

using namespace test;

constexpr double kWeight = 125 * kGravity;

const Material kRough{.restitution = 0, .friction = 0.5};

// Crates on top of each other.
World stack(int count) {
  World world = floorWorld(kRough);
  for (int k = 0; k < count; ++k) {
    world.bodies.push_back(
        crate("crate" + std::to_string(k), Vec3::Constant(0.25), Vec3(0, 0, 0.25 + 0.5 * k), kRough));
  }
  return world;
}

// The upper one sleeps on the lower one, which carries its weight with four points; the lower one is awake.
struct Carried {
  Carried() : stages(world) {
    stages.members[stages.of(1)].asleep = true;
    stages.members[stages.of(1)].cluster = static_cast<int>(stages.of(1));
    stages.meet(test::kCrowdStep);
    for (const int slot : stages.contacts.near()) {
      if (stages.members[stages.contacts[slot].b].isBox()) {
        support = &stages.contacts[slot];
      }
    }
    support->carries = true;
    support->carried = Vec3(0, 0, -kWeight);  // on the lower one
    push(1);
  }
  void push(double part) const {
    for (int k = 0; k < support->count; ++k) {
      support->points[at(k)].normalImpulse = part * kWeight * support->span / support->count;
    }
  }
  bool stillSleepsAfter(double part) {
    push(part);
    stages.sleep.findDisturbed();
    stages.sleep.wakeDisturbed();
    return stages.members[stages.of(1)].asleep;
  }

  World world = stack(2);
  CrowdStages stages;
  PileManifold* support = nullptr;
};

// An eighth of what it carried and the weight, together two weights: a quarter of the weight.
TEST(CrowdSleep, supportThatLeavesWakesWhatItCarried) {
  Carried carried;
  ASSERT_EQ(carried.support->count, 4);
  EXPECT_TRUE(carried.stillSleepsAfter(0.8));
  EXPECT_TRUE(carried.stillSleepsAfter(1.2));
  EXPECT_FALSE(carried.stillSleepsAfter(0.7));
  EXPECT_TRUE(Carried().stillSleepsAfter(1));
  EXPECT_FALSE(Carried().stillSleepsAfter(0));
}

// A strike is one by four times that.
TEST(CrowdSleep, strikeWakesWithinTheStep) {
  for (const double speed : {0.0, 5.0}) {
    Carried carried;
    CrowdStages& stages = carried.stages;
    stages.members[stages.of(0)].velocity = Vec3(0, 0, speed);
    stages.meet(test::kCrowdStep);
    stages.impulses.find();
    EXPECT_EQ(stages.sleep.wakeStruck(stages.impulses.solver()), speed > 0);
    EXPECT_EQ(stages.members[stages.of(1)].asleep, speed == 0);
  }
}

// If it carries nothing: by more than the tolerated part of gravity in a step.
TEST(CrowdSleep, moverThatComesWakesBeforeItPushes) {
  for (const double speed : {-0.001, 0.1}) {
    Carried carried;
    CrowdStages& stages = carried.stages;
    carried.support->carries = false;
    stages.members[stages.of(0)].velocity = Vec3(0, 0, speed) - test::kCrowdStep * carried.world.gravity;
    EXPECT_EQ(stages.sleep.wakePushed(), speed > 0);
    EXPECT_EQ(stages.members[stages.of(1)].asleep, speed < 0);
  }
}

// All forces balance, nothing moves.
TEST(CrowdSleep, stackAtRestSleepsAtOnce) {
  const World world = stack(3);
  CrowdStages stages(world);
  stages.take(test::kCrowdStep);
  EXPECT_TRUE(stages.sleep.freeze());
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(stages.members[stages.of(k)].asleep);
    EXPECT_EQ(stages.members[stages.of(k)].cluster, stages.members[stages.of(0)].cluster);
  }
}

// Motion that friction cannot stop in a step: μ g h.
TEST(CrowdSleep, whatSlidesFasterThanFrictionStopsStaysAwake) {
  for (const double times : {0.9, 1.1}) {
    const World world = stack(1);
    CrowdStages stages(world);
    stages.take(test::kCrowdStep);
    stages.members[stages.of(0)].velocity = Vec3(times * 0.5 * kGravity * test::kCrowdStep, 0, 0);
    EXPECT_EQ(stages.sleep.freeze(), times < 1) << times;
  }
}

// A row of crates that lean on each other, the first of which does not rest: those more than three contacts
// from it sleep, after four checks.
TEST(CrowdSleep, partFarFromWhatMovesMaySleep) {
  World world = floorWorld(kRough);
  constexpr int kCount = 10;
  for (int k = 0; k < kCount; ++k) {
    world.bodies.push_back(
        crate("crate" + std::to_string(k), Vec3::Constant(0.25), Vec3(0.5 * k, 0, 0.25), kRough));
  }
  CrowdStages stages(world);
  stages.take(test::kCrowdStep);
  for (const int slot : stages.contacts.near()) {
    stages.contacts[slot].points[0].normalImpulse += 1e-9;  // all push: one cluster
  }
  stages.members.ways[stages.of(0)].unrest = 1;
  for (int check = 1; check <= 4; ++check) {
    for (int k = 0; k < kCount; ++k) {
      EXPECT_FALSE(stages.members[stages.of(k)].asleep) << check;
    }
    EXPECT_FALSE(stages.sleep.freeze());
  }
  for (int k = 0; k < kCount; ++k) {
    EXPECT_EQ(stages.members[stages.of(k)].asleep, k > 3) << k;
  }
}

}  // namespace
}  // namespace careen
