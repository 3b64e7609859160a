// What the library reads and how it runs scenes, beside the program.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "library/beside_program.h"
#include "library/careen.h"

namespace careen::v1 {
namespace {

const std::filesystem::path kScene = std::filesystem::path(CAREEN_SOURCE_DIR) / "assets/scenes/zeno.json";

class LibraryReads : public BesideProgram {
 protected:
  // Whether a run's file is that of `careen simulate` with these arguments.
  testing::AssertionResult isThatOf(const v1::Run& run, std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "simulate");
    arguments.insert(arguments.end(), {"-o", "theirs.careen"});
    program(arguments);
    run.save(folder_ / "own.careen");
    return textOf(folder_ / "own.careen") == textOf(folder_ / "theirs.careen")
               ? testing::AssertionSuccess()
               : testing::AssertionFailure() << "other bytes than the program's";
  }
};

// Lines of a report that say nothing of time spent.
std::vector<std::string> figuresIn(const std::string& report) {
  std::vector<std::string> lines;
  std::istringstream stream(report);
  for (std::string line; std::getline(stream, line);) {
    if (line.find("seconds") == std::string::npos && line.find("\"simulate\"") == std::string::npos) {
      lines.push_back(line);
    }
  }
  return lines;
}

double numberAfter(const std::string& text, const std::string& key) {
  const std::size_t at = text.find(key);
  EXPECT_NE(at, std::string::npos) << key;
  return at == std::string::npos ? 0 : std::strtod(text.c_str() + at + key.size(), nullptr);
}

TEST_F(LibraryReads, scenesAreRunAsOptionsSay) {
  const std::string scene = kScene;
  EXPECT_TRUE(isThatOf(simulate(Scene::read(kScene).duration(0.7)), {scene, "--duration", "0.7"}));
  EXPECT_TRUE(isThatOf(simulate(Scene::read(kScene).method("listing1").step(0.01)),
                       {scene, "--method", "listing1", "--dt", "0.01"}));
  const v1::Run ended = simulate(Scene::read(kScene).until("rest"));
  EXPECT_LT(ended.duration(), simulate(Scene::read(kScene)).duration());
  EXPECT_TRUE(isThatOf(ended, {scene, "--until", "rest"}));
  EXPECT_THROW(simulate(Scene::read(kScene).step(0.01)), Error) << "exact has no step";
  EXPECT_THROW(simulate(Scene::read(kScene).until("rust")), Error);
}

TEST_F(LibraryReads, boxesThatOverlapAreMovedApartIfTheyMay) {
  const std::string text =
      R"({"careen": 1, "duration": 1, "boxes": [{"name": "a", "half_extents": [1, 1, 1], "mass": 1},
          {"name": "b", "half_extents": [1, 1, 1], "mass": 1, "position": [1.9, 0, 0]}]})";
  folder_.write("scene.json", text);
  EXPECT_THROW(simulate(Scene::parse(text)), SceneError);
  const v1::Run run = simulate(Scene::read(folder_ / "scene.json").allowOverlap());
  EXPECT_NEAR(run.state(1, 0).position[0] - run.state(0, 0).position[0], 2, 1e-12);
  EXPECT_TRUE(isThatOf(run, {"scene.json", "--allow-overlap"}));
}

TEST_F(LibraryReads, modelsOfMujocoAreScenes) {
  folder_.write("model.xml",
                R"(<mujoco><option gravity="0 0 -9.81" timestep="0.001"/>
                   <worldbody><geom type="plane" size="1 1 1"/><body pos="0 0 1"><freejoint/>
                   <geom type="box" size=".1 .2 .3" mass="1"/></body></worldbody></mujoco>)");
  Scene scene = Scene::read(folder_ / "model.xml");
  EXPECT_FALSE(scene.notes().empty());
  EXPECT_TRUE(isThatOf(simulate(scene), {"model.xml"}));
  EXPECT_TRUE(Scene::read(kScene).notes().empty());
  folder_.write("broken.xml", "<mujoco><worldbody>");
  EXPECT_THROW(Scene::read(folder_ / "broken.xml"), SceneError);
}

TEST_F(LibraryReads, tablesOfPosesAreRunsOfTheirScene) {
  const v1::Run run = simulate(Scene::read(kScene));
  run.exportTo(folder_ / "poses.csv", 0.01);
  const v1::Run table = v1::Run::read(folder_ / "poses.csv", kScene);
  for (const double time : {0.0, 0.25, 0.5}) {  // rows of the table
    EXPECT_EQ(table.state(0, time).position, run.state(0, time).position) << time;
  }
  EXPECT_FALSE(table.estimateError().has_value());
  EXPECT_THROW(v1::Run::read(folder_ / "poses.csv"), Error);
  run.save(folder_ / "run.careen");
  EXPECT_EQ(v1::Run::read(folder_ / "run.careen", kScene).hash(), run.hash());
}

TEST_F(LibraryReads, reportsAndEstimatesAreTheProgramsOwn) {
  program({"simulate", kScene, "--report", "report.json", "--estimate-error"});
  const std::string theirs = textOf(folder_ / "report.json");
  const v1::Run run = simulate(Scene::read(kScene));
  const std::optional<ErrorEstimate> estimate = run.estimateError();
  ASSERT_TRUE(estimate.has_value());
  const std::string told = theirs.substr(theirs.find("\"error_estimate\""));
  EXPECT_EQ(estimate->position, numberAfter(told, "\"position\": "));
  EXPECT_EQ(estimate->angle, numberAfter(told, "\"angle\": "));
  EXPECT_EQ(estimate->until, numberAfter(told, "\"until\": "));
  program({"simulate", kScene, "--report", "report.json", "--no-estimate-error"});
  EXPECT_EQ(figuresIn(run.report()), figuresIn(textOf(folder_ / "report.json")));
}

}  // namespace
}  // namespace careen::v1
