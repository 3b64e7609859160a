// Films of several runs, as their user meets them.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/process.h"

namespace careen {
namespace {

const std::string kThrown = R"({
  "careen": 1, "duration": 0.5, "gravity": [0, 0, -10], "room": { "min": [-2, -2, 0], "max": [2, 2, 4], "restitution": 0.8 },
  "boxes": [ { "name": "crate", "half_extents": [0.3, 0.2, 0.1], "mass": 1, "position": [0, 0, 0.5],
               "velocity": [1, 0, 2], "angular_velocity": [1, 2, 3] } ],
  "film": { "size": [64, 48], "fps": 10 } })";

class RenderOtherRuns : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("scene.json", kThrown);
    ASSERT_EQ(careen({"simulate", "scene.json", "-o", "exact.careen"}).exitCode +
                  careen({"simulate", "scene.json", "-o", "old.careen", "--method", "listing1", "--dt",
                          "0.01", "--keep-going"})
                      .exitCode,
              0);
  }

  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), CAREEN_BINARY);
    return Process(arguments, folder_.path()).wait();
  }

  TemporaryFolder folder_;
};

TEST_F(RenderOtherRuns, havePlotsBelow) {
  const Ended ended = careen({"render", "exact.careen", "--beside", "old.careen", "--plot", "distance",
                              "--out", "film", "--video", "film.mkv"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("128x62"), std::string::npos) << ended.out;
  const Ended other =
      careen({"render", "exact.careen", "--beside", "old.careen", "--out", "film", "--resume"});
  EXPECT_EQ(other.exitCode, 2);
  EXPECT_NE(other.err.find("plot distance there, none now"), std::string::npos) << other.err;
  EXPECT_EQ(careen({"render", "exact.careen", "--plot", "energy", "--still", "0.3"}).exitCode, 0);
  const Ended alone = careen({"render", "exact.careen", "--plot", "distance", "--still", "0.3"});
  EXPECT_EQ(alone.exitCode, 2);
  EXPECT_NE(alone.err.find("--plot: found distance, expected --beside"), std::string::npos) << alone.err;
  const Ended unknown = careen({"render", "exact.careen", "--plot", "heat"});
  EXPECT_NE(unknown.err.find("--plot: found 'heat', expected one of: energy, speed, distance"),
            std::string::npos)
      << unknown.err;
}

TEST_F(RenderOtherRuns, areBesideItInOneFilm) {
  const std::vector<std::string> both = {"render",     "exact.careen", "--beside",
                                         "old.careen", "--names",      "exact,1997"};
  std::vector<std::string> film = both;
  film.insert(film.end(), {"--out", "film"});
  const Ended ended = careen(film);
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("128x48"), std::string::npos) << ended.out;
  const std::string manifest = textOf(folder_ / "film/film.json");
  EXPECT_NE(manifest.find("\"beside\""), std::string::npos);
  // A frame is the same as a still, and a lost one is drawn again to the same bytes.
  const std::string frame = textOf(folder_ / "film/000003.png");
  std::vector<std::string> still = both;
  still.insert(still.end(), {"--still", "0.3", "--out", "still.png"});
  ASSERT_EQ(careen(still).exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "still.png"), frame);
  std::filesystem::remove(folder_ / "film/000003.png");
  film.emplace_back("--resume");
  ASSERT_EQ(careen(film).exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "film/000003.png"), frame);
  // It is not the film of that run alone.
  const Ended alone = careen({"render", "exact.careen", "--out", "film", "--resume"});
  EXPECT_EQ(alone.exitCode, 2);
  EXPECT_NE(alone.err.find("beside"), std::string::npos) << alone.err;
}

TEST_F(RenderOtherRuns, areRunsAndHaveNames) {
  const Ended scene = careen({"render", "exact.careen", "--beside", "scene.json", "--out", "film"});
  EXPECT_EQ(scene.exitCode, 2);
  EXPECT_NE(scene.err.find("--beside: found scene.json, expected a trajectory file or a table of poses"),
            std::string::npos)
      << scene.err;
  const Ended names =
      careen({"render", "exact.careen", "--beside", "old.careen", "--names", "one", "--out", "film"});
  EXPECT_EQ(names.exitCode, 2);
  EXPECT_NE(names.err.find("--names: found 1, expected 2"), std::string::npos) << names.err;
  EXPECT_EQ(careen({"render", "exact.careen", "--beside", "old.careen", "--ghost", "old.careen"}).exitCode,
            2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "film"));
}

}  // namespace
}  // namespace careen
