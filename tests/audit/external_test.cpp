#include "audit/external.h"

#include <gtest/gtest.h>

#include <utility>

#include "support/exact_runs.h"

namespace careen {
namespace {

// A body that moves at a constant velocity, for which impulses are known in closed form.
Trajectory drifting(const Vec3& velocity) {
  Trajectory run;
  run.settings = {.duration = 2};
  run.world.bodies = {box("drifter", Vec3::Ones(), 3, Vec3::Zero(), velocity)};
  Flight flight;
  flight.velocity = velocity;
  run.tracks = {{.segments = {{.start = 0, .motion = flight}}}};
  return run;
}

External over(const Trajectory& run, double time, std::vector<std::size_t> impacts = {},
              std::vector<std::size_t> springs = {}) {
  const ExchangeGroup group{.bodies = {0}, .springs = std::move(springs), .impacts = std::move(impacts)};
  ExternalOf following(run, group, Vec3(0, 1, 0));
  following.until(0);
  following.until(time / 3);
  External first = following.until(time);
  ExternalOf again(run, group, Vec3(0, 1, 0));
  again.until(0);
  return again.until(time);
}

TEST(External, gravityPullsAtTheCentre) {
  Trajectory run = drifting(Vec3(2, 0, 0));
  run.world.gravity = Vec3(0, 0, -10);
  const External given = over(run, 2);
  EXPECT_NEAR((given.impulse - Vec3(0, 0, -60)).norm(), 0, 1e-13);
  // ∫ (2t, −1, 0) × (0, 0, −30) dt = ∫ (30, 60t, 0) dt
  EXPECT_NEAR((given.angularImpulse - Vec3(60, 120, 0)).norm(), 0, 1e-12);
}

TEST(External, dragTakesWhatTheWayCosts) {
  Trajectory run = drifting(Vec3(2, 0, 0));
  run.world.drag = Drag{.linear = 0.5, .angular = 0};
  const External given = over(run, 2);
  EXPECT_NEAR((given.impulse - Vec3(-2, 0, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR((given.angularImpulse - Vec3(0, -1, 0).cross(Vec3(-2, 0, 0))).norm(), 0, 1e-13);
}

TEST(External, springsToTheWorldPull) {
  Trajectory run = drifting(Vec3(1, 0, 0));
  run.world.springs = {{.from = {.body = 0}, .to = {.body = {}, .point = Vec3(-1, 0, 0)}, .stiffness = 7}};
  // ∫ −7 (1 + t) dt from 0 to 2
  EXPECT_NEAR((over(run, 2, {}, {0}).impulse - Vec3(-28, 0, 0)).norm(), 0, 1e-12);
}

TEST(External, recordedImpactsOfWallsGiveTheirImpulse) {
  Trajectory run = drifting(Vec3(1, 0, 0));
  run.world.walls = {wall("floor", Vec3(0, 0, 1), -1, 0.5)};
  run.world.bodies[0].material.restitution = 0.5;
  run.impacts = {{.time = 0.5,
                  .a = {0},
                  .b = Partner::ofWall(0),
                  .point = Vec3(1, 0, -1),
                  .impulse = 4,
                  .tangential = 1},
                 {.time = 1.5, .a = {0}, .b = Partner::ofWall(0), .impulse = 9}};
  const External given = over(run, 1, {0, 1});
  EXPECT_EQ(given.impulse, Vec3(0, 0, 4));
  EXPECT_EQ(given.angularImpulse, Vec3(1, -1, -1).cross(Vec3(0, 0, 4)));
  EXPECT_EQ(given.friction, 1);
  EXPECT_TRUE(given.losesInImpacts);
}

TEST(External, whatRestsLiesOnTheWallsThatItTouches) {
  Trajectory run = drifting(Vec3::Zero());
  run.world.walls = {wall("floor", Vec3(0, 0, 1), -1), wall("side", Vec3(1, 0, 0), -5)};
  EXPECT_FALSE(over(run, 1).lies);
  run.tracks[0].segments.open().push_back({.start = 0.5, .motion = Rest{}});
  const External given = over(run, 1);
  EXPECT_TRUE(given.lies);
  ASSERT_EQ(given.walls.size(), 1U);
  EXPECT_EQ(given.walls[0].normal, Vec3(0, 0, 1));
  EXPECT_FALSE(given.liesOnImmovable);
}

TEST(External, whatRestsOnAnImmovableBodyIsKnown) {
  Trajectory run = drifting(Vec3::Zero());
  run.world.bodies.push_back(box("table", Vec3::Ones(), 1, Vec3(0, 0, -2)));
  run.world.bodies.back().mass = immovable();
  run.tracks.push_back({.segments = {{.start = 0, .motion = Rest{{.position = Vec3(0, 0, -2)}}}}});
  run.tracks[0].segments = {{.start = 0, .motion = Rest{}}};
  EXPECT_TRUE(over(run, 1).liesOnImmovable);
}

// Springs move bodies by steps too, which then need not touch: two cubes of 2 m at rest beside each other.
TEST(External, whatSpringsJoinLiesOnlyWhereItTouches) {
  const auto lies = [](double apart) {
    Trajectory run = drifting(Vec3::Zero());
    run.world.bodies.push_back(box("other", Vec3::Ones(), 3, Vec3(apart, 0, 0)));
    run.world.springs = {{.from = {.body = 0}, .to = {.body = 1}, .stiffness = 1}};
    run.tracks[0].segments = {{.start = 0, .motion = Rest{}}};
    run.tracks.push_back({.segments = {{.start = 0, .motion = Rest{{.position = Vec3(apart, 0, 0)}}}}});
    const ExchangeGroup group{.bodies = {0, 1}, .springs = {0}, .impacts = {}};
    ExternalOf following(run, group, Vec3::Zero());
    return std::pair(following.until(0).lies, following.until(1).lies);
  };
  EXPECT_EQ(lies(2), std::pair(true, true));
  EXPECT_EQ(lies(2.5), std::pair(false, false));
}

// Joined like that too; in each other they push nothing if they pass through each other.
TEST(External, whatJointsJoinLiesOnlyWhereItTouches) {
  Trajectory run = drifting(Vec3::Zero());
  run.world.bodies.push_back(box("other", Vec3::Ones(), 3, Vec3(1, 0, 0)));
  run.world.joints = {{.name = "pin", .from = {.body = 0}, .to = {.body = 1}}};
  run.tracks[0].segments = {{.start = 0, .motion = Rest{}}};
  run.tracks.push_back({.segments = {{.start = 0, .motion = Rest{{.position = Vec3(1, 0, 0)}}}}});
  const ExchangeGroup group{.bodies = {0, 1}, .springs = {}, .joints = {0}, .impacts = {}};
  EXPECT_TRUE(ExternalOf(run, group, Vec3::Zero()).until(1).lies);
  run.world.apart = {{0, 1}};
  EXPECT_FALSE(ExternalOf(run, group, Vec3::Zero()).until(1).lies);
}

// A joint between two that move holds neither; one to the world does, until it lets go.
TEST(External, jointsToTheWorldHold) {
  Trajectory run = drifting(Vec3::Zero());
  const ExchangeGroup group{.bodies = {0}, .springs = {}, .joints = {0}, .impacts = {}};
  const auto held = [&](const Joint& joint) {
    run.world.joints = {joint};
    ExternalOf following(run, group, Vec3::Zero());
    const bool first = following.until(1).isHeld;
    return std::pair(first, following.until(2).isHeld);
  };
  const Joint pin{.name = "joint", .kind = Joint::Kind::kBall, .from = {.body = 0}, .to = {}};
  EXPECT_EQ(held(pin), std::pair(true, true));
  Joint brief = pin;
  brief.until = 0.75;
  EXPECT_EQ(held(brief), std::pair(true, false));
  Joint table = pin;
  table.to.body = 1;
  run.world.bodies.push_back(box("table", Vec3::Ones(), 1, Vec3(0, 0, -5)));
  run.tracks.push_back({.segments = {{.start = 0, .motion = Rest{{.position = Vec3(0, 0, -5)}}}}});
  EXPECT_EQ(held(table), std::pair(false, false));
  run.world.bodies.back().mass = immovable();
  EXPECT_EQ(held(table), std::pair(true, true));
}

}  // namespace
}  // namespace careen
