// Films of the runs of a sweep, as their user meets them.
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

const std::string kFilmedFamily = R"({ "careen": 1, "name": "toss", "duration": 0.3, "gravity": [0, 0, -9.81],
  "film": { "size": [64, 36], "fps": 10 },
  "walls": [ { "point": [0, 0, 0], "normal": [0, 0, 1], "restitution": 0.9 } ],
  "boxes": [ { "name": "die", "half_extents": [0.1, 0.1, 0.1], "mass": 1, "restitution": 0.9,
               "position": [0, 0, { "uniform": [0.3, 0.6] }], "orientation": { "rotation": "uniform" } } ] })";

class RenderSweep : public testing::Test {
 protected:
  void SetUp() override { folder_.write("family.json", kFilmedFamily); }
  static std::vector<std::string> sweepOf(const std::string& runs, const std::string& out,
                                          const std::vector<std::string>& options) {
    std::vector<std::string> command = {program(), "sweep", "family.json", "--runs", runs, "--out", out};
    command.insert(command.end(), options.begin(), options.end());
    return command;
  }
  Ended sweep(const std::string& runs, const std::string& out,
              const std::vector<std::string>& options) const {
    return Process(sweepOf(runs, out, options), folder_.path()).wait();
  }
  std::string bytes(const std::string& name) const { return textOf(folder_ / name); }
  /// Pictures under a folder, with their names relative to it.
  std::vector<std::string> picturesIn(const std::string& folder) const {
    std::vector<std::string> names;
    for (const std::string& name : folder_.files()) {
      if (name.starts_with(folder + "/") && name.ends_with(".png")) {
        names.push_back(name.substr(folder.size() + 1));
      }
    }
    return names;
  }

  TemporaryFolder folder_;
};

TEST_F(RenderSweep, filmOfARunIsThatOfRender) {
  const Ended ended = sweep(
      "3-5", "toss", {"--film", "--truth", "depth", "--size", "48x27", "--frames", "0-1", "--keep", "runs"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("toss/runs: a folder for each run"), std::string::npos) << ended.out;
  EXPECT_EQ(picturesIn("toss/runs"),
            (std::vector<std::string>{"0000003/000000.png", "0000003/000001.png", "0000004/000000.png",
                                      "0000004/000001.png", "0000005/000000.png", "0000005/000001.png"}));
  const Ended film = Process({program(), "render", "toss/runs/0000004.careen", "--size", "48x27", "--frames",
                              "0-1", "--truth", "depth", "--out", "one"},
                             folder_.path())
                         .wait();
  ASSERT_EQ(film.exitCode, 0) << film.err;
  for (const char* const name : {"000000.png", "000001.png", "000001.npz", "film.json", "truth.json"}) {
    ASSERT_FALSE(bytes(std::string("one/") + name).empty()) << name;
    EXPECT_EQ(bytes(std::string("toss/runs/0000004/") + name), bytes(std::string("one/") + name)) << name;
  }
  EXPECT_NE(bytes("toss/runs/0000003/000001.png"), bytes("toss/runs/0000004/000001.png"));
  EXPECT_EQ(Process({program(), "verify", "toss/runs/0000003"}, folder_.path()).wait().exitCode, 0);
}

TEST_F(RenderSweep, killedOneIsResumedAndEachFilmIsWholeOrNotThere) {
  ASSERT_EQ(sweep("0-7", "whole", {"--film"}).exitCode, 0);
  ASSERT_EQ(picturesIn("whole/runs").size(), 24U);
  Process first(sweepOf("0-7", "cut", {"--film", "--jobs", "1"}), folder_.path());
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!std::filesystem::exists(folder_ / "cut/runs/0000001") &&
         std::chrono::steady_clock::now() < patience) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  first.send(SIGKILL);
  EXPECT_EQ(first.wait().signal, SIGKILL);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cut/table.csv"));
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "cut/runs")) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with('.')) {
      EXPECT_EQ(picturesIn("cut/runs/" + name).size(), 3U) << name;
    }
  }
  const Ended resumed = sweep("0-7", "cut", {"--film", "--resume"});
  ASSERT_EQ(resumed.exitCode, 0) << resumed.err;
  EXPECT_EQ(resumed.out.find(" 0 of them were there already"), std::string::npos) << resumed.out;
  EXPECT_EQ(bytes("cut/table.csv"), bytes("whole/table.csv"));
  ASSERT_EQ(picturesIn("cut/runs"), picturesIn("whole/runs")) << "no partial ones either";
  for (const std::string& name : picturesIn("whole/runs")) {
    EXPECT_EQ(bytes("cut/runs/" + name), bytes("whole/runs/" + name)) << name;
  }
}

TEST_F(RenderSweep, sharesFilmTheirRuns) {
  ASSERT_EQ(sweep("0-3", "whole", {"--film"}).exitCode, 0);
  Process one(sweepOf("0-3", "parts", {"--film", "--share", "0/2"}), folder_.path());
  Process other(sweepOf("0-3", "parts", {"--film", "--share", "1/2"}), folder_.path());
  EXPECT_EQ(one.wait().exitCode, 0);
  EXPECT_EQ(other.wait().exitCode, 0);
  EXPECT_EQ(picturesIn("parts/runs"), picturesIn("whole/runs"));
  const Ended without = sweep("0-3", "parts", {"--resume"});
  EXPECT_EQ(without.exitCode, 2);
  EXPECT_NE(without.err.find("sweep.json differs in: film"), std::string::npos) << without.err;
  const Ended join = sweep("0-3", "parts", {"--film", "--resume"});
  ASSERT_EQ(join.exitCode, 0) << join.err;
  EXPECT_NE(join.out.find("runs         0 in "), std::string::npos) << join.out;
  EXPECT_EQ(bytes("parts/table.csv"), bytes("whole/table.csv"));
}

TEST_F(RenderSweep, refusesFramesThatTheFilmsDoNotHaveAndLeavesNothing) {
  const Ended ended = sweep("0-3", "toss", {"--film", "--frames", "3"});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_NE(ended.err.find("frames: found 3, expected frames from 0 to 2"), std::string::npos) << ended.err;
  const Ended size = sweep("0-3", "toss", {"--film", "--size", "big"});
  EXPECT_EQ(size.exitCode, 2);
  EXPECT_NE(size.err.find("--size: found 'big'"), std::string::npos) << size.err;
  EXPECT_EQ(folder_.files(), std::vector<std::string>{"family.json"});
}

}  // namespace
}  // namespace careen
