// No input reaches a shell, crashes the program, or takes endless time or memory.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "support/process.h"
#include "support/program.h"

namespace careen {
namespace {

const std::string kFall =
    R"({ "careen": 1, "name": "fall, \"q\" `touch made`", "duration": 1, "gravity": [0, 0, -10],
  "boxes": [ { "name": "crate", "half_extents": [0.3, 0.2, 0.1], "mass": 1, "position": [0, 0, 1],
               "angular_velocity": [1, 2, 3] } ] })";

class HostileInput : public testing::Test {
 protected:
  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program());
    return Process(arguments, folder_.path()).wait();
  }

  TemporaryFolder folder_;
};

TEST_F(HostileInput, namesReachNoShell) {
  const std::string scene = "a';system('touch made');'.json";
  folder_.write(scene, kFall);
  for (const std::string out : {"|touch made", "it's", "a,\"b\"\nc"}) {
    const Ended ended = careen({"study", scene, "--quick", "--methods", "exact", "--out", out});
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    EXPECT_TRUE(std::filesystem::exists(folder_ / out / "plots" / "matrix.png")) << out;
    EXPECT_TRUE(
        std::filesystem::exists(folder_ / out / "plots" / (scene.substr(0, scene.size() - 5) + ".svg")));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "made")) << out;
  }
}

// Sizes, masses and speeds that the schema allows: a run, or a message why there is none. A limit on memory
// turns what would be endless into a failure.
TEST_F(HostileInput, extremeNumbersEndInARunOrInAMessage) {
  const std::string head = R"({ "careen": 1, "duration": 1, )";
  for (const std::string& rest :
       {std::string(R"("boxes": [ { "half_extents": [2.4e-14, 4.8e-14, 7.2e-14], "mass": 5.6e-28,
          "angular_velocity": [1, 2, 3] } ] })"),
        std::string(
            R"("boxes": [ { "half_extents": [1e-30, 2e-30, 3e-30], "mass": 1e-20, "velocity": [1, 2, 3],
          "angular_velocity": [1e-25, 2e-25, 0] } ] })"),
        std::string(R"("boxes": [ { "half_extents": [1e60, 1e-60, 1], "mass": 1e60, "velocity": [1e60, 0, 0],
          "angular_velocity": [1e60, 1e60, 1e-60] } ] })"),
        std::string(R"("gravity": [0, 0, -1e60], "room": { "min": [-1, -1, -1], "max": [1, 1, 1] },
          "boxes": [ { "half_extents": [0.1, 0.2, 0.3], "mass": 1, "angular_velocity": [1e30, 1, 1e-30] } ] })")}) {
    folder_.write("scene.json", head + rest);
    const Ended ended =
        Process({"bash", "-c",
                 "ulimit -v 8000000; exec \"$0\" simulate scene.json -o run.careen --poses p.csv", program()},
                folder_.path())
            .wait();
    EXPECT_TRUE(ended.exitCode == 0 || ended.exitCode == 2 || ended.exitCode == 4)
        << ended.exitCode << ' ' << ended.signal << ended.err << rest;
    if (ended.exitCode == 0) {
      EXPECT_EQ(textOf(folder_ / "p.csv").find("nan"), std::string::npos) << rest;
    } else {
      EXPECT_NE(ended.err, "") << rest;
    }
  }
}

// 10¹¹ frames in 130 bytes.
TEST_F(HostileInput, aManifestListsNoMoreFramesThanFitInMemory) {
  folder_.write("film.json", R"({"careen_film":1,"scene_hash":"a","state_hash":"b","size":[1,1],"fps":"30",
    "frame_count":1000000000,"frames":"0-999999999"})");
  const Ended ended =
      Process({"bash", "-c", "ulimit -v 1000000; exec \"$0\" verify .", program()}, folder_.path()).wait();
  EXPECT_EQ(ended.exitCode, 2) << ended.err;
  EXPECT_NE(ended.err.find("found 1000000000 frames, expected at most 10000000 at once"), std::string::npos)
      << ended.err;
}

}  // namespace
}  // namespace careen
