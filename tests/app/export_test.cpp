// Runs as files of other programs, as their user meets them.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/glb.h"
#include "support/process.h"
#include "support/program.h"

namespace careen {
namespace {

const std::string kTossScene = R"({
  "careen": 1, "name": "toss", "duration": 0.8, "gravity": [0, 0, -9.81],
  "walls": [ { "name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1], "friction": 0.2, "restitution": 0.3 } ],
  "boxes": [ { "name": "die", "half_extents": [0.05, 0.05, 0.05], "mass": 0.3,
               "position": [0, 0, 0.3], "friction": 0.2, "restitution": 0.3, "velocity": [1, 0, 0.5],
               "angular_velocity": [1, 5, 3] } ] })";

class Export : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("scene.json", kTossScene);
    ASSERT_EQ(careen({"simulate", "scene.json", "-o", "run.careen", "--poses", "expected.csv"}).exitCode, 0);
  }
  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program());
    return Process(arguments, folder_.path()).wait();
  }
  std::string refusal(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "export");
    const std::vector<std::string> before = folder_.files();
    const Ended ended = careen(std::move(arguments));
    EXPECT_EQ(ended.exitCode, 2) << ended.out;
    EXPECT_EQ(folder_.files(), before);
    return ended.err;
  }

  TemporaryFolder folder_;
};

TEST_F(Export, writesTheFormatThatTheSuffixNames) {
  const Ended ended = careen({"export", "run.careen", "--out", "film.glb"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const Glb glb(textOf(folder_ / "film.glb"));
  EXPECT_EQ(glb.json.at("asset").at("extras").at("within"), 1e-4);
  EXPECT_TRUE(glb.json.at("asset").at("generator").get<std::string>().starts_with("careen "));
  ASSERT_EQ(careen({"export", "run.careen", "--out", "poses.csv"}).exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "poses.csv"), textOf(folder_ / "expected.csv"));
  ASSERT_EQ(careen({"export", "run.careen", "--out", "run.npz", "--every", "0.1"}).exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "run.npz").substr(0, 2), "PK");
}

TEST_F(Export, tellsWhatMjcfCannotSay) {
  const Ended ended = careen({"export", "run.careen", "--out", "scene.xml"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("left out     restitution, up to 0.3"), std::string::npos) << ended.out;
  EXPECT_NE(textOf(folder_ / "scene.xml").find("<body name=\"die\""), std::string::npos);
  EXPECT_NE(refusal({"run.careen", "--out", "f.xml", "--every", "1"}).find("--every"), std::string::npos);
}

TEST_F(Export, takesScenesAndTablesToo) {
  EXPECT_EQ(careen({"export", "scene.json", "--out", "a.glb"}).exitCode, 0);
  EXPECT_EQ(careen({"export", "expected.csv", "--scene", "scene.json", "--out", "b.glb"}).exitCode, 0);
  ASSERT_EQ(careen({"export", "run.careen", "--out", "c.glb"}).exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "a.glb"), textOf(folder_ / "c.glb"));
  EXPECT_NE(refusal({"expected.csv", "--out", "b2.glb"}).find("expected --scene"), std::string::npos);
}

TEST_F(Export, refusesWhatItCannotDo) {
  EXPECT_NE(
      refusal({"run.careen", "--out", "film.usd"}).find("'film.usd', expected a file that ends in .glb"),
      std::string::npos);
  EXPECT_NE(
      refusal({"run.careen", "--out", "f.glb", "--within", "0"}).find("--within: found 0, expected 1e-07"),
      std::string::npos);
  EXPECT_NE(refusal({"run.careen", "--out", "f.glb", "--within", "nan"}).find("--within: found nan"),
            std::string::npos);
  EXPECT_NE(refusal({"run.careen", "--out", "f.glb", "--every", "1"})
                .find("--every: found the file f.glb, which has no rows"),
            std::string::npos);
  EXPECT_NE(refusal({"run.careen", "--out", "f.csv", "--within", "1"}).find("--within: found the file f.csv"),
            std::string::npos);
  EXPECT_NE(refusal({"missing.careen", "--out", "f.glb"}).find("missing.careen"), std::string::npos);
  EXPECT_NE(refusal({"scene.json", "--out", "scene.json"}).find("--out"), std::string::npos);
  EXPECT_EQ(textOf(folder_ / "scene.json"), kTossScene);
  folder_.write("cut.careen", textOf(folder_ / "run.careen").substr(0, 900));
  EXPECT_NE(refusal({"cut.careen", "--out", "f.glb"}).find("cut.careen"), std::string::npos);
}

TEST_F(Export, aFullDiskLeavesTheOldFileWhole) {
  folder_.write("film.glb", "old");
  // Nobody can write into a folder that is not there, nor into /dev/full.
  const Ended ended = careen({"export", "run.careen", "--out", "nowhere/film.glb"});
  EXPECT_EQ(ended.exitCode, 3) << ended.err;
  const std::string limited =
      "ulimit -f 8; exec " + program() + " export run.careen --out film.glb --within 1e-6";
  const Ended full = Process({"bash", "-c", limited}, folder_.path()).wait();
  EXPECT_NE(full.exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "film.glb"), "old");
}

}  // namespace
}  // namespace careen
