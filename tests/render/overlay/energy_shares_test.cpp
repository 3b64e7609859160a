#include "render/overlay/energy_shares.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/stage.h"

namespace careen {
namespace {

// Dropped flat from rest: 2 kg fall 0.8 m to the floor under 10 m/s², and bounce to e² of that.
Scene dropped(double restitution) {
  Scene scene;
  scene.settings.duration = 1.2;
  scene.gravity = Vec3(0, 0, -10);
  scene.room.emplace();
  scene.room->min = Vec3(-2, -2, 0);
  scene.room->max = Vec3(2, 2, 4);
  scene.room->material.restitution = restitution;
  scene.boxes.push_back(boxAt(Vec3(0, 0, 1), Vec3(0.3, 0.3, 0.2)));
  scene.boxes[0].mass = 2;
  return scene;
}

TEST(EnergyShares, fallTurnsPotentialIntoKinetic) {
  const Scene scene = dropped(1);
  const Trajectory trajectory = runOf(scene);
  const EnergyBook book(trajectory);
  EXPECT_NEAR(book.atStart(), 16, 1e-12);  // 2 kg · 10 m/s² · 0.8 m
  for (const double time : {0.0, 0.1, 0.25, 0.39}) {
    const EnergyShares shares = book.sharesOf(trajectory.states(time), time);
    EXPECT_NEAR(shares.translation, 100 * time * time, 1e-11);
    EXPECT_NEAR(shares.gravity, 16 - 100 * time * time, 1e-11);
    EXPECT_EQ(shares.rotation, 0);
  }
}

// It has fallen .2 m when gravity turns over, and .2 m more until it does, too: by the second gravity it is
// lowest where it began, 1 m up, and has 20 J for each metre below.
TEST(EnergyShares, eachGravityHasItsOwnLowestPlace) {
  Scene scene = dropped(1);
  scene.settings.duration = 0.5;
  scene.gravityChanges = {{.time = 0.2, .gravity = Vec3(0, 0, 10)}};
  const Trajectory trajectory = runOf(scene);
  const EnergyBook book(trajectory);
  for (int k = 0; k <= 50; ++k) {
    const double time = k / 100.0;
    const EnergyShares shares = book.sharesOf(trajectory.states(time), time);
    EXPECT_GE(shares.gravity, -1e-12) << time;
    if (time > 0.2) {
      EXPECT_NEAR(shares.gravity, 20 * (1 - trajectory.state(0, time).pose.position.z()), 1e-11);
    }
  }
}

// That of a gravity between two is never above what it has: none is negative, nor jumps.
TEST(EnergyShares, slopesHaveTheLowestPlacesBetween) {
  Scene scene = dropped(1);
  scene.settings.duration = 0.5;
  scene.gravityPath = GravityPath::kLinear;
  scene.gravityChanges = {{.time = 0.4, .gravity = Vec3(0, 0, 10)}};
  const Trajectory trajectory = runOf(scene);
  const EnergyBook book(trajectory);
  double before = book.sharesOf(trajectory.states(0), 0).gravity;
  for (int k = 1; k <= 500; ++k) {
    const double time = k / 1000.0;
    const double now = book.sharesOf(trajectory.states(time), time).gravity;
    EXPECT_GE(now, -1e-12) << time;
    EXPECT_NEAR(now, before, 0.1) << time;
    before = now;
  }
}

TEST(EnergyShares, bounceTakesWhatRestitutionSays) {
  const Scene scene = dropped(0.5);
  const Trajectory trajectory = runOf(scene);
  const EnergyBook book(trajectory);
  EXPECT_NEAR(book.sharesOf(trajectory.states(0.5), 0.5).sum(), 4, 1e-9);  // once struck, at 0.4 s
  EXPECT_NEAR(book.largest(), 16, 1e-9);  // it comes to rest 1.5e-12 m lower than it should
}

TEST(EnergyShares, sumStaysInAnElasticRoom) {
  Scene scene = crateInRoom();
  scene.settings.duration = 10;
  scene.room->open = {};
  scene.room->material.restitution = 1;
  scene.boxes[0].velocity = Vec3(3, 2, 1);
  scene.boxes[0].angularVelocity = Vec3(3, 7, -2);
  const Trajectory trajectory = runOf(scene);
  const EnergyBook book(trajectory);
  ASSERT_GT(trajectory.impacts.size(), 10U);
  double leastRotation = 1e9;
  double mostRotation = 0;
  for (int k = 0; k <= 300; ++k) {
    const EnergyShares shares = book.sharesOf(trajectory.states(k / 30.0), k / 30.0);
    EXPECT_NEAR(shares.sum(), book.atStart(), 1e-9 * book.atStart()) << k;
    EXPECT_GE(shares.gravity, 0);
    leastRotation = std::min(leastRotation, shares.rotation);
    mostRotation = std::max(mostRotation, shares.rotation);
  }
  EXPECT_GT(mostRotation, 2 * leastRotation);  // it does go from one to the other
}

TEST(EnergyShares, springHoldsWhatItWasStretchedBy) {
  Scene scene = crateInRoom();
  scene.gravity = Vec3::Zero();
  Spring spring;
  spring.from = {.body = 0, .point = Vec3::Zero()};
  spring.to = {.body = std::nullopt, .point = Vec3(0, 0, 3)};
  spring.stiffness = 8;
  spring.restLength = 0.5;
  scene.springs.push_back(spring);
  const Trajectory trajectory =
      drifting(scene, Vec3(0, 0, 1));  // by hand: 2 m long at first, 1 m shorter later
  const EnergyBook book(trajectory);
  EXPECT_TRUE(book.hasSprings());
  EXPECT_NEAR(book.sharesOf(trajectory.states(0), 0).springs, 9, 1e-12);      // ½ · 8 · 1.5²
  EXPECT_NEAR(book.sharesOf(trajectory.states(0.5), 0.5).springs, 4, 1e-12);  // ½ · 8 · 1²
}

// Along z it is at 1 m, and its spring rests at 0.5 m.
TEST(EnergyShares, springsOfJointsCount) {
  Trajectory trajectory = runOf(dropped(1));
  Joint rail;
  rail.kind = Joint::Kind::kSlider;
  rail.from.body = 0;
  rail.stiffness = 8;
  rail.rest = 0.5;
  trajectory.world.joints = {rail};
  const EnergyBook book(trajectory);
  EXPECT_TRUE(book.hasSprings());
  EXPECT_NEAR(book.atStart(), 16 + 1, 1e-12);  // ½ · 8 · 0.5²
}

TEST(EnergyShares, whatIsHeldHasNone) {
  Scene scene = dropped(1);
  scene.boxes[0].fixed = true;
  const Trajectory trajectory = runOf(scene);
  const EnergyBook book(trajectory);
  EXPECT_EQ(book.atStart(), 0);
  EXPECT_EQ(book.sharesOf(trajectory.states(0.7), 0.7).sum(), 0);
}

}  // namespace
}  // namespace careen
