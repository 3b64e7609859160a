// No input reaches a shell, crashes the program, or takes endless time or memory.
#include <gtest/gtest.h>

#include <csignal>
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

TEST_F(HostileInput, stepsWithoutEndAreRefusedUnlessAskedFor) {
  folder_.write("scene.json", R"({ "careen": 1, "duration": 10, "method": "listing1", "dt": 1e-60,
    "boxes": [ { "half_extents": [0.1, 0.1, 0.1], "mass": 1, "velocity": [3, 1, 0] } ] })");
  Ended ended = careen({"simulate", "scene.json"});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_NE(ended.err.find("which makes 1e+61 steps of boxes, expected at most 1e+09; --limit allows more"),
            std::string::npos)
      << ended.err;
  ended = careen({"simulate", "scene.json", "--dt", "0.001", "--limit", "1000"});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_NE(ended.err.find("the run takes more than 1000 pieces of motion and impacts, at 1 s of 10 s"),
            std::string::npos)
      << ended.err;
  EXPECT_EQ(careen({"simulate", "scene.json", "--dt", "0.001", "--limit", "20000"}).exitCode, 0);
  EXPECT_EQ(careen({"simulate", "scene.json", "--limit", "0"}).exitCode, 2);
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

TEST_F(HostileInput, manyKeysAreReadInLinearTime) {
  std::string scene = "{";
  for (int i = 0; i < 200'000; ++i) {
    scene += "\"key" + std::to_string(i) + "\": 1,";
  }
  folder_.write("scene.json", scene + "\"careen\": 1 }");
  const Ended ended = careen({"info", "scene.json"});
  EXPECT_EQ(ended.exitCode, 2) << ended.err;
  EXPECT_LT(ended.coreSeconds, 20);  // quadratic: minutes
}

TEST_F(HostileInput, manyBoxesAreReadInLinearTime) {
  std::string scene = R"({ "careen": 1, "duration": 1, "boxes": [)";
  for (int i = 0; i < 100'000; ++i) {
    scene += std::string(i == 0 ? "" : ",") +
             R"({ "half_extents": [0.4, 0.4, 0.4], "mass": 1, "position": [)" + std::to_string(i) +
             ", 0, 0] }";
  }
  folder_.write("scene.json", scene + "] }");
  const Ended ended = careen({"info", "scene.json"});
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_LT(ended.coreSeconds, 20);  // measured 1; quadratic: 40
}

TEST_F(HostileInput, outputsAreWrittenOverNoInputAndNotOverEachOther) {
  folder_.write("s.json", kFall);
  std::filesystem::create_symlink("s.json", folder_ / "link.careen");
  std::filesystem::create_hard_link(folder_ / "s.json", folder_ / "hard.csv");
  std::filesystem::create_directory_symlink(".", folder_ / "here");
  const std::vector<std::vector<std::string>> wrong = {{"-o", "s.json"},
                                                       {"-o", "link.careen"},
                                                       {"--poses", "hard.csv"},
                                                       {"--report", "./s.json"},
                                                       {"--poses", "t.csv", "--impacts", "here/t.csv"},
                                                       {"-o", "t", "--report", "t"}};
  for (const std::vector<std::string>& options : wrong) {
    std::vector<std::string> arguments = {"simulate", "s.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ended ended = careen(arguments);
    EXPECT_EQ(ended.exitCode, 2) << options[1];
    EXPECT_NE(ended.err.find("expected a file of its own"), std::string::npos) << ended.err;
    EXPECT_EQ(textOf(folder_ / "s.json"), kFall);
  }
}

TEST_F(HostileInput, namesDoNotSteerTheTerminal) {
  folder_.write("scene.json",
                R"({ "careen": 1, "duration": 0.1, "name": "\u001b]0;OWNED\u0007\u009b2J\nfake line",
    "boxes": [ { "half_extents": [0.4, 0.2, 0.1], "mass": 1, "name": "\u202egnp" } ] })");
  const Ended done = careen({"simulate", "scene.json"});
  EXPECT_EQ(done.exitCode, 0);
  EXPECT_NE(done.out.find(R"(scene        \x1b]0;OWNED\x07\x9b2J\x0afake line, 1 box)"), std::string::npos)
      << done.out;
  for (const Ended& ended : {done, careen({"simulate", "\x1b[2J.json"}), careen({"\x1b[2J"})}) {
    EXPECT_EQ((ended.out + ended.err).find('\x1b'), std::string::npos) << ended.err;
  }
}

TEST_F(HostileInput, whatCannotBePrintedIsAFailure) {
  folder_.write("scene.json", kFall);
  const Ended ended =
      Process({"bash", "-c", "exec \"$0\" info scene.json > /dev/full", program()}, folder_.path()).wait();
  EXPECT_EQ(ended.exitCode, 3);
  EXPECT_NE(ended.err.find("standard output cannot be written"), std::string::npos) << ended.err;
}

TEST_F(HostileInput, withoutACommandTheHelpIsShown) {
  const Ended ended = careen({});
  EXPECT_EQ(ended.exitCode, 0);
  EXPECT_NE(ended.out.find("simulate"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace careen
