#include "trajectory/trajectory_format.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "core/hash.h"
#include "core/names.h"
#include "physics/world/method.h"
#include "support/exact_runs.h"
#include "support/input_error.h"
#include "support/trajectories.h"

namespace careen {
namespace {

std::string written(const Trajectory& run) {
  ArchiveWriter writer;
  visit(writer, run);
  return std::move(writer.bytes());
}

Trajectory readAgain(const std::string& bytes) {
  ArchiveReader reader(bytes, "run.careen");
  Trajectory run;
  visit(reader, run);
  EXPECT_TRUE(reader.atEnd());
  return run;
}

// Every number another, so that none can stand in another's place.
Stage everyPart() {
  Stage stage;
  stage.name = "a stage";
  stage.room.emplace();
  stage.room->min = Vec3(-1, -2, -3);
  stage.room->max = Vec3(4, 5, 6);
  stage.room->open = {false, true, false, true, true, false};
  stage.planes = {{.normal = Vec3(0, 0.6, 0.8), .offset = 0.5}, {.normal = Vec3::UnitX(), .offset = -7}};
  stage.colors = {{1, 2, 3}, {4, 5, 6}};
  stage.camera =
      Camera{.eye = Vec3(1, -8, 2), .target = Vec3(0.5, 0, 1), .up = Vec3::UnitZ(), .fovDegrees = 33};
  stage.cameraMove.followed = 1;
  stage.cameraMove.keys = {{.time = 0, .eye = Vec3(1, -8, 2), .target = Vec3(0.5, 0, 1), .fovDegrees = 33},
                           {.time = 2, .eye = Vec3(2, -8, 3), .target = Vec3(0.5, 1, 1), .fovDegrees = 44}};
  stage.timeMap.keys = {{.film = 0, .scene = 0.25}, {.film = 3, .scene = 0.75}};
  stage.picture = {.width = 640,
                   .height = 360,
                   .rate = {.numerator = 24000, .denominator = 1001},
                   .look = Look::kClay,
                   .antialiasing = Antialiasing::kMultisampled,
                   .shutter = {.degrees = 123.456, .samples = 7},
                   .overlays = OverlaySet::named("trail,energy")};
  return stage;
}

TEST(TrajectoryFormat, bringsBackWorldStageAndPlan) {
  Trajectory run = driftAndReturn();
  run.stage = everyPart();
  run.plan.items = {{.what = "gravity", .modelled = true, .reason = "the scene sets it"},
                    {.what = "drag", .modelled = false, .reason = "the scene has none"}};
  run.world.gravity = Vec3(1, 2, -9);
  run.world.bodies[0].material = {.restitution = 0.25, .friction = 0.125};
  run.world.springs = {{.from = {.body = 1, .point = Vec3(1, 2, 3)},
                        .to = {.body = {}, .point = Vec3(4, 5, 6)},
                        .stiffness = 7,
                        .damping = 8,
                        .restLength = 9}};
  run.world.drag = Drag{.linear = 0.5, .angular = 0.75};
  const std::string bytes = written(run);
  const Trajectory back = readAgain(bytes);
  EXPECT_EQ(written(back), bytes);

  EXPECT_EQ(back.world.gravity, Vec3(1, 2, -9));
  EXPECT_EQ(back.world.bodies[0].halfExtents, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(back.world.bodies[0].material.friction, 0.125);
  EXPECT_EQ(back.world.bodies[0].initial.velocity, Vec3(2, 0, 0));
  EXPECT_EQ(back.world.walls[1].name, "room+x");
  EXPECT_EQ(back.world.walls[1].offset, -2.1);
  ASSERT_EQ(back.world.springs.size(), 1U);
  EXPECT_EQ(back.world.springs[0].from.body, 1);
  EXPECT_FALSE(back.world.springs[0].to.body);
  EXPECT_EQ(back.world.springs[0].to.point, Vec3(4, 5, 6));
  EXPECT_EQ(back.world.springs[0].restLength, 9);
  EXPECT_EQ(back.world.drag->angular, 0.75);
  EXPECT_EQ(back.plan.modelled(), std::vector<std::string>{"gravity"});
  EXPECT_EQ(back.plan.items[1].reason, "the scene has none");

  const Stage& stage = back.stage;
  EXPECT_EQ(stage.name, "a stage");
  EXPECT_EQ(stage.room->max, Vec3(4, 5, 6));
  EXPECT_EQ(stage.room->open, run.stage.room->open);
  ASSERT_EQ(stage.planes.size(), 2U);
  EXPECT_EQ(stage.planes[1].offset, -7);
  EXPECT_EQ(stage.colors[1].blue, 6);
  EXPECT_EQ(stage.camera->fovDegrees, 33);
  EXPECT_EQ(stage.cameraMove.followed, 1);
  EXPECT_EQ(stage.cameraMove.keys[1].target, Vec3(0.5, 1, 1));
  EXPECT_EQ(stage.timeMap.keys[1].scene, 0.75);
  EXPECT_EQ(stage.picture.width, 640);
  EXPECT_EQ(stage.picture.height, 360);
  EXPECT_EQ(stage.picture.rate.text(), "24000/1001");
  EXPECT_EQ(stage.picture.look, Look::kClay);
  EXPECT_EQ(stage.picture.antialiasing, Antialiasing::kMultisampled);
  EXPECT_EQ(stage.picture.shutter.degrees, 123.456);
  EXPECT_EQ(stage.picture.shutter.samples, 7);
  EXPECT_EQ(stage.picture.overlays.text(), "trail,energy");
}

// Another value means another format: it needs a version of its own, or old files are misread.
TEST(TrajectoryFormat, hasTheBytesOfVersion4) {
  Trajectory run = driftAndReturn();
  run.stage = everyPart();
  Hash hash;
  hash.add(written(run));
  EXPECT_EQ(hash.text(), "0306617b34d02686");
}

// Methods are stored by name. This one came with earlier versions.
TEST(TrajectoryFormat, refusesARunOfAMethodThatIsNoMore) {
  std::string bytes = written(record(elasticRoom(), {.method = Method::kStrang, .duration = 1}, "{}"));
  const std::size_t at = bytes.find("strang");
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, 6, "splitting-6");
  bytes[at - 8] = 11;  // the name's length
  EXPECT_EQ(inputErrorOf([&] { readAgain(bytes); }),
            "run.careen: this trajectory file was made by the method 'splitting-6', expected one of " +
                listed(kMethodNames));
}

}  // namespace
}  // namespace careen
