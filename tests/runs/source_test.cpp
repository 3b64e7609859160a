#include "runs/source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/system/file.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "support/input_error.h"
#include "support/process.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

constexpr const char* kScene =
    R"({"careen": 1, "duration": 1, "gravity": [0, 0, -10], "film": {"size": [64, 36]},
        "boxes": [{"name": "crate", "half_extents": [0.5, 0.5, 0.5], "mass": 1, "position": [0, 0, 9]}]})";
constexpr const char* kModel = R"(<mujoco><option timestep="0.001" gravity="0 0 -10"/><worldbody>
    <body pos="0 0 9"><freejoint/><geom type="box" size=".5 .5 .5" mass="1"/></body></worldbody></mujoco>)";

// Falls from 9 m, in rows of a quarter of a second from `from` on.
std::string tableFrom(double from) {
  std::string rows = "time,box,x,y,z,qw,qx,qy,qz\n";
  for (int k = 0; k < 4; ++k) {
    const double t = 0.25 * k;
    rows += std::to_string(from + t) + ",crate,0,0," + std::to_string(9 - 5 * t * t) + ",1,0,0,0\n";
  }
  return rows;
}

class Source : public testing::Test {
 protected:
  Source() {
    folder_.write("scene.json", kScene);
    folder_.write("model.xml", kModel);
    folder_.write("poses.csv", tableFrom(0));
    saveTrajectory(record(setupOf(parseScene(kScene, "scene"))), folder_ / "run.careen");
  }
  RunReading reading(std::optional<std::filesystem::path> scene = {}) {
    return {.scene = std::move(scene),
            .notice = [this](const std::string& each) { notices_.push_back(each); }};
  }

  TemporaryFolder folder_;
  std::vector<std::string> notices_;
};

TEST_F(Source, knowsWhatFilesAre) {
  EXPECT_TRUE(isRun(folder_ / "run.careen"));
  EXPECT_TRUE(isRun(folder_ / "poses.csv"));
  EXPECT_FALSE(isRun(folder_ / "scene.json"));
  EXPECT_FALSE(isRun(folder_ / "model.xml"));
  EXPECT_FALSE(isRun(folder_ / "nothing"));
  EXPECT_FALSE(isTable(folder_ / "run.careen"));
  EXPECT_TRUE(isTable(folder_ / "poses.csv"));
  EXPECT_TRUE(isMujocoModel("a/b.xml"));
  EXPECT_FALSE(isMujocoModel("a/b.json"));
}

TEST_F(Source, modelsOfMujocoAreScenesAndWhatTheyLackIsTold) {
  const auto notice = [this](const std::string& each) { notices_.push_back(each); };
  const auto [text, name] = sceneTextOf(folder_ / "model.xml", kModel, notice);
  EXPECT_EQ(parseScene(text, name).boxes.size(), 1U);
  ASSERT_FALSE(notices_.empty());
  EXPECT_NE(notices_.front().find("model.xml: "), std::string::npos) << notices_.front();
  notices_.clear();
  EXPECT_EQ(sceneTextOf(folder_ / "scene.json", kScene, notice).text, kScene);
  EXPECT_TRUE(notices_.empty());
  EXPECT_EQ(setupOfScene(folder_ / "model.xml", notice).world.bodies.size(), 1U);
}

TEST_F(Source, tablesAreOfTheirSceneOrOfTheSetupGiven) {
  const Trajectory named = readRun(folder_ / "poses.csv", reading(folder_ / "scene.json"));
  EXPECT_TRUE(named.given.has_value());
  EXPECT_NEAR(named.state(0, 0.5).pose.position.z(), 7.75, 1e-6);
  const Trajectory run = readRun(folder_ / "run.careen", reading());
  const Trajectory given = readRun(folder_ / "poses.csv", reading(), [&]() -> RunSetup { return run; });
  EXPECT_EQ(given.stateHash(), named.stateHash());
  EXPECT_NE(inputErrorOf([&] { readRun(folder_ / "poses.csv", reading()); }).find("expected --scene"),
            std::string::npos);
}

// 0.1 s late: from where the scene has the box. 5 s late: so is a film's clock; it is told.
TEST_F(Source, aTablesClockMayHaveBegunElsewhere) {
  folder_.write("late.csv", tableFrom(0.1));
  EXPECT_EQ(readRun(folder_ / "late.csv", reading(folder_ / "scene.json")).state(0, 0).pose.position.z(), 9);
  EXPECT_TRUE(notices_.empty());
  folder_.write("later.csv", tableFrom(5));
  RunReading later = reading(folder_ / "scene.json");
  EXPECT_NE(inputErrorOf([&] { readRun(folder_ / "later.csv", later); }).find("found a first row at 5 s"),
            std::string::npos);
  later.shiftsTime = true;
  const Trajectory shifted = readRun(folder_ / "later.csv", later);
  EXPECT_NEAR(shifted.state(0, 0.5).pose.position.z(), 7.75, 1e-6);
  std::string lasting = kScene;
  folder_.write("long.json", lasting.replace(lasting.find("\"duration\": 1"), 13, "\"duration\": 9"));
  readRun(folder_ / "later.csv", reading(folder_ / "long.json"));
  ASSERT_EQ(notices_.size(), 1U);
  EXPECT_NE(notices_[0].find("its first row is at 5 s"), std::string::npos) << notices_[0];
}

TEST_F(Source, aTrajectoryIsShownAsAnotherSceneSaysIfThereIsOne) {
  folder_.write("other.json", R"({"careen": 1, "film": {"size": [32, 18]}})");
  EXPECT_EQ(readRun(folder_ / "run.careen", reading()).stage.picture.width, 64);
  EXPECT_EQ(readRun(folder_ / "run.careen", reading(folder_ / "other.json")).stage.picture.width, 32);
}

}  // namespace
}  // namespace careen
