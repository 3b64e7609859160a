#include "trajectory/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/error.h"
#include "physics/world/method.h"
#include "support/trajectories.h"

namespace careen {
namespace {

TEST(Trajectory, isKnownAtAnyMoment) {
  const Trajectory trajectory = driftAndReturn();
  EXPECT_EQ(trajectory.state(0, 0).pose.position, Vec3(1, 0, 0));
  EXPECT_EQ(trajectory.state(0, 0.25).pose.position, Vec3(1.5, 0, 0));
  EXPECT_EQ(trajectory.state(0, 0.75).pose.position, Vec3(1.5, 0, 0));
  EXPECT_EQ(trajectory.state(0, 1).pose.position, Vec3(1, 0, 0));
  EXPECT_EQ(trajectory.state(1, 0.3).pose.position, Vec3(0, 5, 0));
}

TEST(Trajectory, isAfterTheImpactAtItsMoment) {
  const Trajectory trajectory = driftAndReturn();
  EXPECT_EQ(trajectory.state(0, 0.5).velocity, Vec3(-2, 0, 0));
  EXPECT_EQ(trajectory.state(0, std::nextafter(0.5, 0.0)).velocity, Vec3(2, 0, 0));
}

TEST(Trajectory, refusesMomentsOutsideTheRun) {
  const Trajectory trajectory = driftAndReturn();
  EXPECT_THROW(trajectory.state(0, -1e-9), InputError);
  EXPECT_THROW(trajectory.state(0, 1.0000001), InputError);
  EXPECT_THROW(trajectory.state(0, std::nan("")), InputError);
}

TEST(Trajectory, givesEveryBodysPose) {
  const std::vector<Pose> poses = driftAndReturn().poses(0.25);
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].position, Vec3(1.5, 0, 0));
  EXPECT_EQ(poses[1].position, Vec3(0, 5, 0));
}

TEST(Trajectory, stateHashSeesOneBitAndNoOrder) {
  const Trajectory trajectory = driftAndReturn();
  const std::string hash = trajectory.stateHash();

  Trajectory swapped = trajectory;
  std::swap(swapped.tracks[0], swapped.tracks[1]);
  std::swap(swapped.world.bodies[0], swapped.world.bodies[1]);
  EXPECT_EQ(swapped.stateHash(), hash);

  Trajectory nudged = trajectory;
  double& x = std::get<EulerStep>(nudged.tracks[0].segments.open()[1].motion).start.angularMomentum.z();
  x = std::nextafter(x, 1.0);
  EXPECT_NE(nudged.stateHash(), hash);
}

TEST(Trajectory, sceneHashIsThatOfTheText) {
  Trajectory trajectory = driftAndReturn();
  trajectory.sceneText = "a";
  EXPECT_EQ(trajectory.sceneHash(), "af63dc4c8601ec8c");  // published FNV-1a value
}

// A single body without forces: 1 m/s for 2 s.
TEST(Trajectory, recordsWhatTheMethodTells) {
  World world;
  Body body;
  body.name = "drifter";
  body.halfExtents = Vec3(0.5, 0.5, 0.5);
  body.mass = solidBox(body.halfExtents, 1);
  body.initial.velocity = Vec3(1, 0, 0);
  world.bodies.push_back(body);
  world.walls.push_back({.name = "far",
                         .normal = Vec3(-1, 0, 0),
                         .offset = -100,
                         .material = {.restitution = 1, .friction = 0}});
  const Trajectory trajectory =
      record(world, {.method = Method::kListing1, .duration = 2, .dt = 0.25}, "text");
  EXPECT_EQ(trajectory.sceneText, "text");
  ASSERT_EQ(trajectory.world.walls.size(), 1U);
  EXPECT_EQ(trajectory.world.walls[0].name, "far");
  EXPECT_EQ(trajectory.world.bodies[0].halfExtents, Vec3(0.5, 0.5, 0.5));
  EXPECT_EQ(trajectory.stage.colors.size(), 1U);
  EXPECT_EQ(trajectory.state(0, 1.3125).pose.position, Vec3(1.3125, 0, 0));
  EXPECT_TRUE(trajectory.impacts.empty());
}

TEST(Trajectory, impactsThatAreToldLateComeInOrderOfTime) {
  std::vector<Impact> impacts;
  for (const auto& [time, impulse] : {std::pair(1., 10.), {3., 20.}, {2., 30.}, {3., 40.}, {2., 50.}}) {
    insertByTime(impacts, {.time = time, .a = {}, .impulse = impulse});
  }
  std::vector<double> impulses;
  for (const Impact& impact : impacts) {
    impulses.push_back(impact.impulse);
  }
  EXPECT_EQ(impulses, (std::vector<double>{10, 30, 50, 20, 40}));  // of one moment, in the order told
}

// A ball between two walls, 1 m apart for its middle, strikes one each second; asked at each.
TEST(Trajectory, endsWhereThereIsEnough) {
  RunSetup setup;
  setup.settings = {.method = Method::kExact, .duration = 100};
  Body body;
  body.name = "ball";
  body.halfExtents = Vec3(0.5, 0.5, 0.5);
  body.mass = solidBox(body.halfExtents, 1);
  body.material.restitution = 1;
  body.initial.velocity = Vec3(1, 0, 0);
  setup.world.bodies = {body};
  setup.world.walls = {{.name = "-x", .normal = Vec3::UnitX(), .offset = -1, .material = {}},
                       {.name = "+x", .normal = -Vec3::UnitX(), .offset = -1, .material = {}}};
  setup.stage.colors.resize(1);
  std::vector<double> asked;
  const Trajectory run = record(setup, {}, kMostRecords, {}, [&](const Trajectory& soFar, double time) {
    EXPECT_EQ(soFar.tracks.size(), 1U);
    asked.push_back(time);
    return time > 3;
  });
  EXPECT_NEAR(run.settings.duration, 3.5, 1e-12);
  EXPECT_EQ(asked.back(), run.settings.duration);
  EXPECT_NEAR(run.impacts.back().time, 2.5, 1e-12);
  EXPECT_NEAR(run.state(0, run.settings.duration).pose.position.x(), -0.5, 1e-12);
  setup.settings = {.method = Method::kListing1, .duration = 1, .dt = 0.25};
  EXPECT_EQ(record(setup, {}, kMostRecords, {}, [](const auto&...) { return true; }).settings.duration, 1);
}

TEST(Trajectory, stopsWhenAsked) {
  World world;
  Body body;
  body.name = "drifter";
  body.halfExtents = Vec3(0.5, 0.5, 0.5);
  body.mass = solidBox(body.halfExtents, 1);
  world.bodies.push_back(body);
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(
      record(world, {.method = Method::kListing1, .duration = 2, .dt = 0.25}, "", source.get_token()),
      Interrupted);
}

}  // namespace
}  // namespace careen
