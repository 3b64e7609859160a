// Labels of pixels, as their user meets them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/process.h"
#include "support/program.h"

namespace careen {
namespace {

const std::string kTruthScene = R"({
  "careen": 1, "name": "toss", "duration": 0.5, "gravity": [0, 0, -9.81],
  "walls": [ { "name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1], "friction": 0.2, "restitution": 0.3 } ],
  "boxes": [ { "name": "die", "half_extents": [0.05, 0.05, 0.05], "mass": 0.3,
               "position": [0, 0, 0.3], "friction": 0.2, "restitution": 0.3, "velocity": [1, 0, 0.5],
               "angular_velocity": [1, 5, 3] } ],
  "film": { "size": [64, 36], "fps": 10 } })";

class Truth : public testing::Test {
 protected:
  void SetUp() override { folder_.write("scene.json", kTruthScene); }
  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program());
    return Process(arguments, folder_.path()).wait();
  }
  std::string refusal(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"truth", "scene.json", "--out", "labels"});
    const Ended ended = careen(std::move(arguments));
    EXPECT_EQ(ended.exitCode, 2) << ended.out;
    EXPECT_EQ(folder_.files(), std::vector<std::string>{"scene.json"});
    return ended.err;
  }

  TemporaryFolder folder_;
};

TEST_F(Truth, writesAFileForEachFrameAndOneForAll) {
  const Ended ended =
      careen({"truth", "scene.json", "--out", "labels", "--channels", "depth", "--frames", "1-3"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(folder_.files(),
            (std::vector<std::string>{"labels", "labels/000001.npz", "labels/000002.npz", "labels/000003.npz",
                                      "labels/truth.json", "scene.json"}));
  const nlohmann::json truth = nlohmann::json::parse(textOf(folder_ / "labels/truth.json"));
  EXPECT_EQ(truth["channels"], "depth");
  EXPECT_EQ(truth["frames"].size(), 3U);
  ASSERT_EQ(careen({"truth", "scene.json", "--out", "big", "--size", "128x72", "--fps", "2"}).exitCode, 0);
  EXPECT_EQ(nlohmann::json::parse(textOf(folder_ / "big/truth.json"))["size"], nlohmann::json({128, 72}));
}

TEST_F(Truth, refusesWhatItCannotDo) {
  EXPECT_NE(refusal({"--channels", "depth,color"}).find("--channels: found 'color', expected one of: depth"),
            std::string::npos);
  EXPECT_NE(refusal({"--frames", "4-9"}).find("9"), std::string::npos);
  EXPECT_NE(refusal({"--size", "0x5"}).find("--size"), std::string::npos);
  EXPECT_NE(refusal({"--fps", "none"}).find("--fps"), std::string::npos);
  EXPECT_NE(refusal({"--jobs", "0"}).find("--jobs: found 0"), std::string::npos);
}

TEST_F(Truth, leavesNothingHalfWritten) {
  const std::string limited = "ulimit -f 4; exec " + program() + " truth scene.json --out labels";
  const Ended full = Process({"bash", "-c", limited}, folder_.path()).wait();
  EXPECT_EQ(full.exitCode, 3) << full.err;
  for (const std::string& file : folder_.files()) {
    EXPECT_FALSE(file.ends_with(".npz") || (file.ends_with(".json") && file != "scene.json")) << file;
  }
}

}  // namespace
}  // namespace careen
