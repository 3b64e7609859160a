#include "truth/truth_film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/error.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "support/process.h"
#include "view/camera.h"
#include "view/scene_extent.h"

namespace careen {
namespace {

const char* const kDrop = R"({ "careen": 1, "name": "drop", "duration": 1, "gravity": [0, 0, -10],
  "walls": [ { "name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1], "restitution": 0.5, "friction": 0.25 } ],
  "boxes": [ { "name": "cube", "half_extents": [0.5, 0.5, 0.5], "mass": 3, "position": [0, 0, 1.3],
               "friction": 1, "color": "#102030" } ],
  "camera": { "eye": [0, -8, 2], "target": [0, 0, 0.5], "fov_deg": 40 },
  "film": { "size": [64, 36], "fps": 10, "time": [[0, 0], [2, 1]] } })";

class TruthFilm : public testing::Test {
 protected:
  TruthSettings settings(const std::string& frames, int jobs) {
    return {.folder = folder_ / "truth",
            .frames = frames.empty() ? std::vector<FrameRange>() : parseFrameRanges(frames),
            .channels = channelsNamed("depth,instance"),
            .jobs = jobs,
            .program = "test"};
  }

  TemporaryFolder folder_;
  Trajectory run_ = record(setupOf(parseScene(kDrop, "test")));
};

TEST_F(TruthFilm, isTheSameHoweverTheWorkIsSplit) {
  EXPECT_EQ(writeTruth(run_, settings("0-4", 1)), 5);
  const std::string one = textOf(folder_ / "truth/000003.npz");
  const std::string json = textOf(folder_ / "truth/truth.json");
  std::filesystem::remove_all(folder_ / "truth");
  EXPECT_EQ(writeTruth(run_, settings("0-4", 3)), 5);
  EXPECT_EQ(textOf(folder_ / "truth/000003.npz"), one);
  EXPECT_EQ(textOf(folder_ / "truth/truth.json"), json);
  EXPECT_EQ(folder_.files().size(), 1 + 5 + 1U);
}

TEST_F(TruthFilm, explainsIdsCameraAndImpacts) {
  writeTruth(run_, settings("", 2));
  const nlohmann::json truth = nlohmann::json::parse(textOf(folder_ / "truth/truth.json"));
  EXPECT_EQ(truth["boxes"][0]["id"], 1);
  EXPECT_EQ(truth["boxes"][0]["name"], "cube");
  EXPECT_EQ(truth["boxes"][0]["mass"], 3);
  EXPECT_EQ(truth["boxes"][0]["color"], nlohmann::json({16, 32, 48}));
  EXPECT_EQ(truth["walls"][0]["id"], 2);
  EXPECT_EQ(truth["walls"][0]["name"], "floor");
  EXPECT_EQ(truth["walls"][0]["friction"], 0.25);
  EXPECT_EQ(truth["gravity"][2], -10);
  ASSERT_EQ(truth["frames"].size(), 20U);
  EXPECT_NEAR(truth["frames"][7]["scene_time"], 0.35, 1e-15);
  EXPECT_NEAR(truth["frames"][0]["matrix"][0][0], 18 / std::tan(20 * M_PI / 180), 1e-12);
  // Falls 0.8 m: it strikes at 0.4 s of the scene, 0.8 s of the film, at four corners at once.
  ASSERT_GE(truth["impacts"].size(), 4U);
  const nlohmann::json& impact = truth["impacts"][0];
  EXPECT_NEAR(impact["time"], 0.4, 1e-12);
  EXPECT_TRUE(impact["frame"] == 8 || impact["frame"] == 7)
      << "the frame at the impact's time, up to rounding";
  EXPECT_EQ(impact["b"], "floor");
  const View view = viewOf(*run_.stage.camera, extentOf(run_), 64.0 / 36);
  const Vec3 pixel = view.pixelFromWorld(run_.impacts[0].point, 64, 36);
  EXPECT_NEAR(impact["pixel"][0], pixel.x(), 1e-9);
  EXPECT_NEAR(impact["pixel"][1], pixel.y(), 1e-9);
}

TEST_F(TruthFilm, listsTheBoxesOfABody) {
  run_ = record(setupOf(parseScene(R"({ "careen": 1, "duration": 0.1, "boxes": [
    { "name": "hammer", "mass": 4, "position": [1, 2, 3],
      "parts": [ { "half_extents": [0.5, 0.1, 0.1] },
                 { "half_extents": [0.1, 0.1, 0.5], "position": [1, 0, 0], "orientation": { "axis": [0, 0, 1], "angle_deg": 90 } } ] } ],
  "camera": { "eye": [0, -8, 2], "target": [0, 0, 0.5] }, "film": { "size": [64, 36], "fps": 10 } })",
                                   "test")));
  writeTruth(run_, settings("0", 1));
  const nlohmann::json hammer = nlohmann::json::parse(textOf(folder_ / "truth/truth.json"))["boxes"][0];
  ASSERT_EQ(hammer["parts"].size(), 2U);
  EXPECT_EQ(hammer["parts"][0]["half_extents"], nlohmann::json({0.5, 0.1, 0.1}));
  const auto near = [&](const nlohmann::json& found, const Vec3& expected) {
    const auto numbers = found.get<std::vector<double>>();
    EXPECT_LT((Vec3(numbers.data()) - expected).norm(), 1e-15) << found;
  };
  near(hammer["parts"][0]["position"], Vec3(0, 0, 0));
  near(hammer["parts"][1]["position"], Vec3(1, 0, 0));
  near(hammer["parts"][1]["axes"][0], Vec3(0, -1, 0));
  near(hammer["center"], Vec3(0.5, 0, 0));            // two of 0.04 m³, at 0 and at 1 m
  near(hammer["half_extents"], Vec3(1.1, 0.1, 0.5));  // of what is around them
}

TEST_F(TruthFilm, refusesFramesThatAreNotThere) {
  EXPECT_THROW(writeTruth(run_, settings("19-20", 1)), InputError);
  EXPECT_TRUE(folder_.files().empty());
}

TEST_F(TruthFilm, aFolderThatCannotBeWrittenIsTold) {
  folder_.write("truth", "a file");
  EXPECT_THROW(writeTruth(run_, settings("0", 1)), MachineError);
}

}  // namespace
}  // namespace careen
