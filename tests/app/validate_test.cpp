// Measured tosses beside simulated ones, as their user meets them.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/process.h"
#include "support/program.h"

namespace careen {
namespace {

const std::string kThrownScene = R"({
  "careen": 1, "name": "toss", "duration": 0.8, "gravity": [0, 0, -9.81],
  "walls": [ { "name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1], "friction": 0.2, "restitution": 0.3 } ],
  "boxes": [ { "name": "die", "half_extents": [0.05, 0.05, 0.05], "mass": 0.3, "inertia": [6e-4, 6e-4, 6e-4],
               "position": [0, 0, 0.3], "friction": 0.2, "restitution": 0.3, "velocity": [1, 0, 0.5],
               "angular_velocity": [1, 5, 3] } ] })";

class Validate : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("scene.json", kThrownScene);
    ASSERT_EQ(careen({"simulate", "scene.json", "-o", "run.careen", "--poses", "one.csv", "--every", "0.005"})
                  .exitCode,
              0);
  }
  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program());
    return Process(arguments, folder_.path()).wait();
  }

  TemporaryFolder folder_;
};

TEST_F(Validate, writesTablesPageAndRuns) {
  const Ended ended = careen({"validate", "one.csv", "--scene", "scene.json", "--no-plots", "--out", "found",
                              "--sweep", "friction=0.1:0.3:0.05"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("faces        1 of 1 right"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("; the scene's 0.2 has"), std::string::npos) << ended.out;
  const nlohmann::json report = nlohmann::json::parse(textOf(folder_ / "found/report.json"));
  EXPECT_LT(report["place"]["mean"], 1e-5);
  EXPECT_EQ(report["sweep"]["points"].size(), 5U);
  EXPECT_NEAR(report["sweep"]["minimum"], 0.2, 0.01);
  for (const char* const file : {"results.csv", "errors.csv", "sweep.csv", "index.html", "runs/one.careen"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / "found" / file)) << file;
  }
  // The run can be compared with, and filmed beside, the measurement.
  EXPECT_EQ(careen({"compare", "found/runs/one.careen", "one.csv", "--motion", "1e-3"}).exitCode, 0);
}

TEST_F(Validate, badUseIsTold) {
  const auto refusal = [this](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "validate");
    const Ended ended = careen(std::move(arguments));
    EXPECT_EQ(ended.exitCode, 2) << ended.out;
    return ended.err;
  };
  refusal({"one.csv"});
  refusal({"--scene", "scene.json"});
  refusal({"one.csv", "--scene", "scene.json", "--start", "last"});
  refusal({"nowhere.csv", "--scene", "scene.json"});
  EXPECT_NE(refusal({"one.csv", "one.csv", "--scene", "scene.json"}).find("names that differ"),
            std::string::npos);
  for (const char* const sweep :
       {"colour=1:2:3", "friction", "friction=1:2", "friction=0.3:0.1:0.1", "friction=0:1:0",
        "restitution=0:2:0.1", "inertia=0:1:0.1", "friction=0:1:1e-9", "friction=a:1:0.1"}) {
    EXPECT_NE(refusal({"one.csv", "--scene", "scene.json", "--sweep", sweep}).find("--sweep: found '"),
              std::string::npos)
        << sweep;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "validation"));
  const Ended ended = careen({"validate", "one.csv", "--scene", "scene.json", "--out", "one.csv"});
  EXPECT_EQ(ended.exitCode, 3);
  EXPECT_NE(ended.err.find("one.csv/runs: cannot be made: Not a directory"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace careen
