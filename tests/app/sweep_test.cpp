// Many runs of a family, as their user meets them.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/process.h"
#include "support/program.h"

namespace careen {
namespace {

const std::string kFamily = R"({ "careen": 1, "name": "toss", "duration": 0.3, "gravity": [0, 0, -9.81],
  "walls": [ { "point": [0, 0, 0], "normal": [0, 0, 1], "restitution": 0.9 } ],
  "boxes": [ { "name": "die", "half_extents": [0.1, 0.1, 0.1], "mass": 1, "restitution": 0.9,
               "position": [0, 0, { "uniform": [0.3, 0.6] }], "orientation": { "rotation": "uniform" } } ] })";

class SweepCommand : public testing::Test {
 protected:
  void SetUp() override { folder_.write("family.json", kFamily); }
  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program());
    return Process(arguments, folder_.path()).wait();
  }
  std::string refusal(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "sweep");
    const Ended ended = careen(std::move(arguments));
    EXPECT_EQ(ended.exitCode, 2) << ended.out;
    EXPECT_EQ(folder_.files(), std::vector<std::string>{"family.json"});
    return ended.err;
  }

  TemporaryFolder folder_;
};

TEST_F(SweepCommand, makesATable) {
  const Ended ended = careen({"sweep", "family.json", "--runs", "0-59", "--out", "found"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("60 rows"), std::string::npos) << ended.out;
  EXPECT_NE(ended.err.find("run 60 of 60, 0 s left"), std::string::npos) << ended.err;
  EXPECT_EQ(folder_.files(), (std::vector<std::string>{"family.json", "found", "found/sweep.json",
                                                       "found/table.csv", "found/table.npz"}));
}

TEST_F(SweepCommand, tasksOfAJobArrayShareIt) {
  ASSERT_EQ(careen({"sweep", "family.json", "--runs", "0-119", "--out", "whole"}).exitCode, 0);
  for (const char* const task : {"0", "1"}) {
    const std::string script =
        "PATH=\"$PWD/bin:$PATH\" SLURM_CPUS_ON_NODE=1 SLURM_ARRAY_TASK_ID=" + std::string(task) +
        " sh " CAREEN_SOURCE_DIR "/app/film_part family.json 2 --runs 0-119 --out parts";
    const std::string link = "mkdir -p bin && ln -sf " + program() + " bin/careen && ";
    const Ended ended = Process({"bash", "-c", link + script}, folder_.path()).wait();
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
  }
  ASSERT_EQ(careen({"sweep", "family.json", "--runs", "0-119", "--out", "parts", "--resume"}).exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "parts/table.csv"), textOf(folder_ / "whole/table.csv"));
}

TEST_F(SweepCommand, refusesWhatItCannotDo) {
  EXPECT_NE(refusal({"family.json", "--runs", "9-3"}).find("--runs: found '9-3'"), std::string::npos);
  EXPECT_NE(refusal({"family.json", "--share", "3/3"}).find("--share: found '3/3'"), std::string::npos);
  EXPECT_NE(refusal({"family.json", "--jobs", "0"}).find("--jobs: found 0"), std::string::npos);
  EXPECT_NE(refusal({"missing.json"}).find("missing.json"), std::string::npos);
  EXPECT_NE(refusal({"family.json", "--truth", "colour"}).find("--truth: "), std::string::npos);
  EXPECT_NE(
      refusal({"family.json", "--out", "toss", "--truth", "depth", "--frames", "9"}).find("frames: found 9"),
      std::string::npos);
  EXPECT_NE(refusal({"family.json", "--frames", "0"}).find("--frames: found no frames that it is for"),
            std::string::npos);
  EXPECT_NE(refusal({"family.json", "--size", "4x4"}).find("--size: found no frames"), std::string::npos);
}

// The manual's way for machines that share no files: each part has a folder of its own.
TEST_F(SweepCommand, partsOfSeveralMachinesAreCopiedTogether) {
  ASSERT_EQ(careen({"sweep", "family.json", "--runs", "0-149", "--out", "whole"}).exitCode, 0);
  const std::string script = "seq 0 2 | xargs -P 2 -I{} " + program() +
                             " sweep family.json --runs 0-149 --share {}/3 --out part-{} --jobs 1 &&"
                             " mkdir parts && cp part-0/sweep.json parts && cp -r part-*/rows parts";
  const Ended copied = Process({"bash", "-c", script}, folder_.path()).wait();
  ASSERT_EQ(copied.exitCode, 0) << copied.err;
  const Ended join = careen({"sweep", "family.json", "--runs", "0-149", "--out", "parts", "--resume"});
  ASSERT_EQ(join.exitCode, 0) << join.err;
  EXPECT_NE(join.out.find("runs         0 in "), std::string::npos) << join.out;
  EXPECT_EQ(textOf(folder_ / "parts/table.csv"), textOf(folder_ / "whole/table.csv"));
}

TEST_F(SweepCommand, labelsOfARunAreThoseOfTruth) {
  const Ended ended =
      careen({"sweep", "family.json", "--runs", "7-8", "--out", "toss", "--truth", "depth,face", "--size",
              "32x18", "--fps", "10", "--frames", "0:2", "--keep", "runs"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  ASSERT_EQ(careen({"truth", "toss/runs/0000008.careen", "--channels", "depth,face", "--size", "32x18",
                    "--fps", "10", "--frames", "0:2", "--out", "one"})
                .exitCode,
            0);
  for (const char* const name : {"000000.npz", "000002.npz", "truth.json"}) {
    ASSERT_FALSE(textOf(folder_ / (std::string("one/") + name)).empty()) << name;
    EXPECT_EQ(textOf(folder_ / (std::string("toss/runs/0000008/") + name)),
              textOf(folder_ / (std::string("one/") + name)))
        << name;
  }
  EXPECT_TRUE(std::filesystem::exists(folder_ / "toss/runs/0000007/truth.json"));
}

TEST_F(SweepCommand, aFullDiskLeavesWholeRowsAndIsResumed) {
  ASSERT_EQ(careen({"sweep", "family.json", "--runs", "0-119", "--out", "whole"}).exitCode, 0);
  const std::string limited =
      "ulimit -f 40; exec " + program() + " sweep family.json --runs 0-119 --out cut";  // less than the table
  const Ended full = Process({"bash", "-c", limited}, folder_.path()).wait();
  EXPECT_NE(full.exitCode, 0) << full.out;  // ended by a signal where a write would fail
  for (const std::string& file : folder_.files()) {
    EXPECT_FALSE(file == "cut/table.csv" || file == "cut/table.npz");
  }
  ASSERT_EQ(careen({"sweep", "family.json", "--runs", "0-119", "--out", "cut", "--resume"}).exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "cut/table.csv"), textOf(folder_ / "whole/table.csv"));
}

TEST_F(SweepCommand, infoTellsWhatVaries) {
  const Ended ended = careen({"info", "family.json"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("varies       boxes[0].position[2]: uniform 0.3 to 0.6\n"), std::string::npos)
      << ended.out;
  EXPECT_NE(ended.out.find("modelled     gravity"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace careen
