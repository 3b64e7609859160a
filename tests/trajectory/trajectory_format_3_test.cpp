#include "trajectory/trajectory_format_3.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>

#include "core/system/file.h"
#include "support/input_error.h"

namespace careen {
namespace {

// Made of falling-pair.json by a version that wrote format 3.
const std::filesystem::path kOldRun =
    std::filesystem::path(CAREEN_SOURCE_DIR) / "tests/scenes/falling-pair-3.careen";

// What that scene makes, by hand.
RunSetup fallingPair() {
  RunSetup setup;
  const Vec3 crate(0.4, 0.3, 0.2);
  const Vec3 post(0.1, 0.1, 0.5);
  setup.world.gravity = Vec3(0, 0, -9.81);
  setup.world.bodies = {
      {.name = "crate", .halfExtents = crate, .mass = solidBox(crate, 2), .material = {}, .initial = {}},
      {.name = "post", .halfExtents = post, .mass = immovable(), .material = {}, .initial = {}}};
  for (const char* wall : {"room-x", "room+x", "room+y", "room-z", "ramp"}) {
    setup.world.walls.push_back({.name = wall, .normal = Vec3::UnitZ(), .offset = 0, .material = {}});
  }
  setup.stage.colors.resize(2);
  return setup;
}

std::string messageOfOldRun(const std::function<void(RunSetup&)>& change) {
  RunSetup setup = fallingPair();
  change(setup);
  return inputErrorOf([&] {
    decodeTrajectory(readFile(kOldRun), "old.careen",
                     [&](const std::string&, const RunSettings&) { return setup; });
  });
}

TEST(TrajectoryFormat3, completesARunFromItsScene) {
  RunSettings asked;
  std::string text;
  const auto setup = [&](const std::string& sceneText, const RunSettings& settings) {
    text = sceneText;
    asked = settings;
    return fallingPair();
  };
  const Trajectory run = decodeTrajectory(readFile(kOldRun), "old.careen", setup);
  EXPECT_NE(text.find("falling pair"), std::string::npos);
  EXPECT_EQ(asked.duration, 0.6);
  EXPECT_EQ(run.sceneText, text);
  EXPECT_EQ(run.stateHash(), "ec6b49ceb9cd0ff7");
  EXPECT_EQ(run.world.bodies[0].initial.pose.position, Vec3(0.5, 0, 0.7));  // as its track has it
  EXPECT_EQ(run.world.bodies[0].initial.velocity, Vec3(1, 0.5, -2));
  const std::string bytes = encodeTrajectory(run);
  EXPECT_EQ(encodeTrajectory(decodeTrajectory(bytes, "new.careen")), bytes);  // now it is whole
}

TEST(TrajectoryFormat3, refusesARunThatItsSceneDoesNotFit) {
  EXPECT_EQ(messageOfOldRun([](RunSetup&) {}), "no error");
  const std::string file = "old.careen: this trajectory file ";
  EXPECT_EQ(messageOfOldRun([](RunSetup& setup) { setup.world.bodies.pop_back(); }),
            file + "has 2 bodies, its scene 1");
  EXPECT_EQ(messageOfOldRun([](RunSetup& setup) { setup.world.bodies[1].name = "pole"; }),
            file + "has a body 'post' where its scene has 'pole'");
  EXPECT_EQ(messageOfOldRun(
                [](RunSetup& setup) { setup.world.bodies[0].mass = solidBox(Vec3(0.4, 0.3, 0.21), 2); }),
            file + "has another mass or inertia of body 'crate' than its scene gives that box");
  EXPECT_EQ(messageOfOldRun([](RunSetup& setup) { setup.world.walls.pop_back(); }),
            file + "has other walls than its scene");
  EXPECT_EQ(messageOfOldRun([](RunSetup& setup) { setup.stage.colors.clear(); }),
            file + "has 0 colours for 2 bodies");
}

TEST(TrajectoryFormat3, refusesARunWhereNobodyKnowsScenes) {
  EXPECT_EQ(inputErrorOf([] { decodeTrajectory(readFile(kOldRun), "old.careen"); }),
            "old.careen: this trajectory file has format version 3, which is read only together with its "
            "scene; expected 4");
}

}  // namespace
}  // namespace careen
