// Films of tables of poses, and films with a ghost.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/process.h"

namespace careen {
namespace {

const std::string kDrawnScene = R"({
  "careen": 1, "name": "toss", "duration": 1, "gravity": [0, 0, -10],
  "room": { "min": [-2, -2, 0], "max": [2, 2, 4], "open": ["-y"], "restitution": 1 },
  "boxes": [ { "name": "crate", "half_extents": [0.3, 0.2, 0.1], "mass": 1, "position": [0, 0, 1],
               "velocity": [1, 0, 2], "angular_velocity": [1, 2, 3] } ],
  "camera": { "eye": [0, -7, 2], "target": [0, 0, 1.5], "fov_deg": 40 },
  "film": { "size": [64, 48], "fps": 10 }
})";

class RenderGivenRuns : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("scene.json", kDrawnScene);
    ASSERT_EQ(careen({"simulate", "scene.json", "-o", "run.careen", "--poses", "run.csv", "--every", "0.05"})
                  .exitCode,
              0);
    ASSERT_EQ(careen({"simulate", "scene.json", "-o", "other.careen", "--method", "listing1"}).exitCode, 0);
  }
  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), CAREEN_BINARY);
    return Process(arguments, folder_.path()).wait();
  }

  TemporaryFolder folder_;
};

TEST_F(RenderGivenRuns, theFilmOfATableIsThatOfItsRun) {
  ASSERT_EQ(careen({"render", "run.careen", "--out", "one", "--frames", "3,7"}).exitCode, 0);
  const Ended ended =
      careen({"render", "run.csv", "--scene", "scene.json", "--out", "two", "--frames", "3,7"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  // The same to the rounding of an attitude, which does not reach the pixels.
  EXPECT_EQ(careen({"compare", "one", "two", "--motion", "any"}).exitCode, 0);
  EXPECT_EQ(careen({"render", "run.csv", "--out", "three"}).exitCode, 2);
}

TEST_F(RenderGivenRuns, aGhostIsDrawnAndKnownToTheFilm) {
  ASSERT_EQ(careen({"render", "run.careen", "--out", "plain", "--frames", "7"}).exitCode, 0);
  for (const char* const ghost : {"other.careen", "run.csv"}) {
    const Ended ended =
        careen({"render", "run.careen", "--ghost", ghost, "--out", "ghost", "--frames", "7", "--overwrite"});
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
    EXPECT_EQ(careen({"compare", "plain", "ghost"}).exitCode, 1) << ghost;
    const nlohmann::json film = nlohmann::json::parse(textOf(folder_ / "ghost/film.json"));
    EXPECT_EQ(film["ghost"].get<std::string>().size(), 16U);
  }
  EXPECT_EQ(careen({"render", "run.careen", "--out", "ghost", "--frames", "7", "--resume"}).exitCode, 2);
  EXPECT_FALSE(nlohmann::json::parse(textOf(folder_ / "plain/film.json")).contains("ghost"));
  EXPECT_EQ(
      careen({"render", "run.careen", "--ghost", "other.careen", "--still", "0.7", "--out", "still.png"})
          .exitCode,
      0);
  EXPECT_EQ(careen({"compare", "plain/000007.png", "still.png"}).exitCode, 1);
}

TEST_F(RenderGivenRuns, aGhostMustBeARunOfTheBoxes) {
  std::string other = kDrawnScene;
  other.replace(other.find("crate"), 5, "other");
  folder_.write("other.json", other);
  ASSERT_EQ(careen({"simulate", "other.json", "-o", "stranger.careen"}).exitCode, 0);
  for (const char* const ghost : {"scene.json", "stranger.careen", "nowhere.careen"}) {
    const Ended ended = careen({"render", "run.careen", "--ghost", ghost, "--out", "film"});
    EXPECT_EQ(ended.exitCode, 2) << ghost << ended.err;
    EXPECT_NE(ended.err.find(ghost), std::string::npos) << ended.err;
  }
}

}  // namespace
}  // namespace careen
