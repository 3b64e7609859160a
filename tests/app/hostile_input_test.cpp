// No input reaches a shell, crashes the program, or takes endless time or memory.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
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

}  // namespace
}  // namespace careen
