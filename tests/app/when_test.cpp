// Questions to runs, and runs that end with an answer, as their user meets them.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/process.h"
#include "support/program.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

// A crate falls by 1 m and slides: it strikes the floor at √(2/g).
const std::string kScene = R"({ "careen": 1, "name": "fall", "duration": 3, "gravity": [0, 0, -9.81],
  "walls": [ { "name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1], "friction": 0.5 } ],
  "boxes": [ { "name": "big crate", "half_extents": [0.2, 0.2, 0.1], "mass": 1, "position": [0, 0, 1.1],
               "velocity": [0.5, 0, 0], "friction": 0.5 } ] })";
const double kFall = std::sqrt(2 / 9.81);  // [s]

class When : public testing::Test {
 protected:
  void SetUp() override { folder_.write("fall.json", kScene); }
  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program());
    return Process(arguments, folder_.path()).wait();
  }
  std::vector<std::string> linesOf(const std::string& text) const {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) {
      lines.push_back(line);
    }
    return lines;
  }

  TemporaryFolder folder_;
};

TEST_F(When, printsAMomentALine) {
  ASSERT_EQ(careen({"simulate", "fall.json", "-o", "fall.careen"}).exitCode, 0);
  for (const char* const run : {"fall.json", "fall.careen"}) {
    const Ended ended = careen({"when", run, "'big crate' touches floor", "height(\"big crate\")<0.6",
                                "'big crate' touches", "spin('big crate') > 100", "-o", "when.csv"});
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
    const std::vector<std::string> lines = linesOf(ended.out);
    ASSERT_EQ(lines.size(), 4U) << ended.out;
    EXPECT_EQ(lines[0], "0.451523640986 s  'big crate' touches floor");
    EXPECT_EQ(lines[1], "0.319275428407 s  height(\"big crate\")<0.6");
    EXPECT_EQ(lines[2], "0.451523640986 s  'big crate' touches: floor");
    EXPECT_EQ(lines[3], "never  spin('big crate') > 100");
    const std::vector<std::string> table = linesOf(textOf(folder_ / "when.csv"));
    ASSERT_EQ(table.size(), 5U);
    EXPECT_EQ(table[0], "question,time,with");
    EXPECT_TRUE(table[1].starts_with("'big crate' touches floor,0.4515236409")) << table[1];
    EXPECT_TRUE(table[1].ends_with(",floor")) << table[1];
    EXPECT_EQ(table[4], "spin('big crate') > 100,nan,");
  }
}

TEST_F(When, tellsOnlyTheFirstIfAsked) {
  const std::string friction = "\"friction\": 0.5";
  folder_.write("bounce.json",
                std::string(kScene).replace(kScene.find(friction), friction.size(), "\"restitution\": 0.5"));
  const std::string question = "'big crate' touches floor";
  EXPECT_GT(linesOf(careen({"when", "bounce.json", question}).out).size(), 3U);
  EXPECT_EQ(careen({"when", "bounce.json", question, "--first"}).out, "0.451523640986 s  " + question + "\n");
}

TEST_F(When, refusesBadQuestionsWithTheirColumn) {
  const Ended unknown = careen({"when", "fall.json", "rest", "height(crate) < 1"});
  EXPECT_EQ(unknown.exitCode, 2);
  EXPECT_EQ(unknown.out, "");
  EXPECT_NE(
      unknown.err.find("question 'height(crate) < 1', column 8: found 'crate', expected a box: big crate"),
      std::string::npos)
      << unknown.err;
  const Ended until = careen({"simulate", "fall.json", "--until", "crate touches floor"});
  EXPECT_EQ(until.exitCode, 2);
  EXPECT_NE(until.err.find("--until: question 'crate touches floor', column 1: found 'crate'"),
            std::string::npos)
      << until.err;
  EXPECT_EQ(careen({"when", "fall.json"}).exitCode, 2);
  EXPECT_EQ(folder_.files(), std::vector<std::string>{"fall.json"});
}

// It slides for 0.5/(μg) after it has fallen, less what friction takes in the impact: μ times its speed along
// the normal, 4.4 m/s, is more than it has, so that it rests at once.
TEST_F(When, untilEndsARun) {
  const Ended ended =
      careen({"simulate", "fall.json", "--until", "rest", "-o", "ended.careen", "--report", "report.json"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("until        rest: at 0.45152364"), std::string::npos) << ended.out;
  const nlohmann::json report = nlohmann::json::parse(textOf(folder_ / "report.json"));
  EXPECT_EQ(report["until"]["question"], "rest");
  EXPECT_EQ(report["until"]["time"], report["simulated_seconds"]);
  EXPECT_NEAR(report["until"]["time"].get<double>(), kFall, 1e-6);
  EXPECT_TRUE(report["breaches"].empty());
  const Trajectory run = readTrajectory(folder_ / "ended.careen");
  EXPECT_EQ(report["state_hash"], run.stateHash());
  EXPECT_EQ(run.settings.duration, report["simulated_seconds"]);
}

TEST_F(When, untilNeverIsTheWholeRun) {
  ASSERT_EQ(careen({"simulate", "fall.json", "-o", "whole.careen"}).exitCode, 0);
  const Ended ended = careen({"simulate", "fall.json", "--until", "height('big crate') > 2", "-o",
                              "until.careen", "--report", "report.json", "--verbose"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("until        height('big crate') > 2: never"), std::string::npos) << ended.out;
  EXPECT_TRUE(nlohmann::json::parse(textOf(folder_ / "report.json"))["until"]["time"].is_null());
  EXPECT_EQ(textOf(folder_ / "whole.careen"), textOf(folder_ / "until.careen"));
}

TEST_F(When, sweepsHaveAColumnForEach) {
  folder_.write("family.json",
                std::string(kScene).replace(kScene.find("1.1"), 3, "{ \"uniform\": [0.5, 2] }"));
  const Ended ended = careen({"sweep", "family.json", "--runs", "0-4", "--out", "found", "--when",
                              "'big crate' touches floor", "--when", "height('big crate') > 3"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const std::vector<std::string> table = linesOf(textOf(folder_ / "found/table.csv"));
  ASSERT_EQ(table.size(), 6U);
  EXPECT_NE(table[0].find(",rest_since,'big crate' touches floor,height('big crate') > 3,run_impacts,"),
            std::string::npos)
      << table[0];
  const auto cells = [](const std::string& line) {
    std::istringstream stream(line);
    std::vector<std::string> found;
    for (std::string cell; std::getline(stream, cell, ',');) {
      found.push_back(cell);
    }
    return found;
  };
  const std::vector<std::string> head = cells(table[0]);
  const auto column = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(head.begin(), head.end(), name) - head.begin());
  };
  for (std::size_t row = 1; row < table.size(); ++row) {
    const std::vector<std::string> cell = cells(table[row]);
    const double height = std::stod(cell.at(column("start_z")));
    EXPECT_NEAR(std::stod(cell.at(column("'big crate' touches floor"))), std::sqrt(2 * (height - 0.1) / 9.81),
                1e-12);
    EXPECT_EQ(cell.at(column("height('big crate') > 3")), "nan");
  }
  const Ended bad = careen({"sweep", "family.json", "--out", "bad", "--when", "rest(x)"});
  EXPECT_EQ(bad.exitCode, 2);
  EXPECT_NE(bad.err.find("column 6: found 'x'"), std::string::npos) << bad.err;
}

}  // namespace
}  // namespace careen
