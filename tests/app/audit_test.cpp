// What the program says and writes of a run that breaks a promise of its method.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/process.h"
#include "support/program.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

// A box that falls where neighbouring doubles are 0.1 mm apart: positions cannot show the momentum promised.
const std::string kFar = (std::filesystem::path(CAREEN_SOURCE_DIR) / "tests/scenes/broken/far.json").string();

class AuditOfRuns : public testing::Test {
 protected:
  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program());
    return Process(arguments, folder_.path()).wait();
  }
  nlohmann::json report() const { return nlohmann::json::parse(textOf(folder_ / "report.json")); }

  TemporaryFolder folder_;
};

TEST_F(AuditOfRuns, aBrokenPromiseEndsWithFourAndWritesNothing) {
  const Ended ended = careen({"simulate", kFar, "-o", "run.careen", "--report", "report.json"});
  EXPECT_EQ(ended.exitCode, 4);
  EXPECT_NE(ended.err.find("breaks what its method promises"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("unexplained linear momentum"), std::string::npos) << ended.err;
  EXPECT_TRUE(folder_.files().empty());
}

TEST_F(AuditOfRuns, keepGoingWritesAndMarks) {
  const Ended ended =
      careen({"simulate", kFar, "-o", "run.careen", "--report", "report.json", "--keep-going", "--verbose"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("\nBROKEN       at "), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("momentum: the method says 0, the audit found 0.00"), std::string::npos)
      << ended.out;
  const Ended inShort = careen({"simulate", kFar, "-o", "run.careen", "--keep-going"});
  EXPECT_NE(inShort.out.find("\nBROKEN       at "), std::string::npos) << inShort.out;
  EXPECT_EQ(inShort.out.find("promises\n"), std::string::npos) << inShort.out;
  const nlohmann::json found = report();
  EXPECT_GT(found["momentum_change"], 0.0005);  // measured 0.0077
  EXPECT_EQ(found["momentum_change"], found["audit"]["linear_momentum"]["size"]);
  EXPECT_EQ(found["audit"]["linear_momentum"]["unit"], "1");
  EXPECT_TRUE(found["audit"]["linear_momentum"]["promised"]);
  EXPECT_GT(found["audit_seconds"], 0);
  ASSERT_EQ(found["breaches"].size(), 1);
  const nlohmann::json& breach = found["breaches"][0];
  EXPECT_EQ(breach["kind"], "linear_momentum");
  EXPECT_EQ(breach["bodies"], (std::vector<std::string>{"a"}));
  EXPECT_GT(breach["time"], 0.5);  // after the box has met the floor
  EXPECT_GT(breach["size"], breach["allowed"]);
  // The run file is audited again wherever it is read.
  EXPECT_EQ(careen({"info", "run.careen"}).exitCode, 4);
}

TEST_F(AuditOfRuns, noneLooksAtNothing) {
  const Ended ended =
      careen({"simulate", kFar, "-o", "run.careen", "--report", "report.json", "--audit", "none"});
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(ended.out.find("audit "), std::string::npos) << ended.out;
  EXPECT_FALSE(report().contains("audit"));
  EXPECT_FALSE(report().contains("breaches"));
}

// Where no audit found as much: here, since only the figure is changed.
TEST_F(AuditOfRuns, aRunsOwnDepthIsHeldAgainstThePromise) {
  folder_.write("fall.json",
                R"({"careen": 1, "duration": 1, "gravity": [0, 0, -9.81], "room": {"min": [-2, -2, 0],
    "max": [2, 2, 4]}, "boxes": [{"half_extents": [0.1, 0.2, 0.3], "mass": 1, "position": [0, 0, 1]}]})");
  ASSERT_EQ(careen({"simulate", "fall.json", "-o", "run.careen"}).exitCode, 0);
  EXPECT_EQ(careen({"info", "run.careen"}).out.find("BROKEN"), std::string::npos);
  Trajectory run = readTrajectory(folder_ / "run.careen");
  run.figures.deepestPenetration = 0.002;
  folder_.write("deep.careen", encodeTrajectory(run));
  const Ended ended = careen({"info", "deep.careen"});
  EXPECT_NE(ended.out.find("BROKEN       by its own figure: boxes or walls went 0.002 m into each other"),
            std::string::npos)
      << ended.out << ended.err;
}

TEST_F(AuditOfRuns, anotherDepthIsBadUsage) {
  EXPECT_EQ(careen({"simulate", kFar, "--audit", "often"}).exitCode, 2);
}

TEST_F(AuditOfRuns, attitudesThatAreNoNumbersAreNoRun) {
  folder_.write("tiny.json", R"({"careen": 1, "duration": 1, "boxes": [{"half_extents": [1e-30, 2e-30, 3e-30],
    "mass": 1e-20, "velocity": [1, 2, 3], "angular_velocity": [1e-25, 2e-25, 0]}]})");
  const Ended ended = careen({"simulate", "tiny.json", "-o", "run.careen"});
  EXPECT_TRUE(ended.exitCode == 4 || ended.exitCode == 2) << ended.exitCode << ended.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "run.careen"));
}

TEST_F(AuditOfRuns, aSoundRunHasNoBreaches) {
  folder_.write("scene.json", R"({"careen": 1, "duration": 1, "gravity": [0, 0, -10],
    "walls": [{"point": [0, 0, 0], "normal": [0, 0, 1]}],
    "boxes": [{"name": "crate", "half_extents": [0.3, 0.2, 0.1], "mass": 1, "position": [0, 0, 1]}]})");
  for (const char* const depth : {"usual", "full"}) {
    const Ended ended =
        careen({"simulate", "scene.json", "-o", "run.careen", "--report", "report.json", "--audit", depth});
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    EXPECT_EQ(report()["breaches"], nlohmann::json::array());
    EXPECT_EQ(report()["audit"].size(), 14U);
  }
}

}  // namespace
}  // namespace careen
