// Tables of poses wherever a run is accepted, as their user meets them.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/process.h"
#include "support/program.h"

namespace careen {
namespace {

const std::string kGivenScene = R"({
  "careen": 1, "name": "toss", "duration": 1, "gravity": [0, 0, -10],
  "room": { "min": [-2, -2, 0], "max": [2, 2, 4], "open": ["-y"], "restitution": 0.8, "friction": 0.2 },
  "boxes": [ { "name": "crate", "half_extents": [0.3, 0.2, 0.1], "mass": 1, "position": [0, 0, 1], "friction": 0.2,
               "velocity": [1, 0, 2], "angular_velocity": [1, 2, 3] } ],
  "film": { "size": [64, 48], "fps": 10 }
})";

class GivenRuns : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("scene.json", kGivenScene);
    const Ended ended = careen({"simulate", "scene.json", "-o", "run.careen", "--poses", "run.csv", "--npz",
                                "run.npz", "--every", "0.01"});
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
  }

  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program());
    return Process(arguments, folder_.path()).wait();
  }
  // The table with 0.1 m/s more along y in each row from this one on, in flight.
  void writeKicked(const std::string& name, int from) {
    std::istringstream lines(textOf(folder_ / "run.csv"));
    std::string text;
    int row = -1;
    for (std::string line; std::getline(lines, line); ++row) {
      if (row >= from) {
        std::vector<std::string> cells;
        std::istringstream stream(line);
        for (std::string cell; std::getline(stream, cell, ',');) {
          cells.push_back(cell);
        }
        cells[3] = std::to_string(std::stod(cells[3]) + 0.1 * 0.01 * (row - from));
        cells[10] = std::to_string(std::stod(cells[10]) + 0.1);
        line.clear();
        for (const std::string& cell : cells) {
          line += (line.empty() ? "" : ",") + cell;
        }
      }
      text += line + '\n';
    }
    folder_.write(name, text);
  }

  TemporaryFolder folder_;
};

TEST_F(GivenRuns, areAuditedWithAnExitCode) {
  for (const char* const table : {"run.csv", "run.npz"}) {
    const Ended sound = careen({"audit", table, "--scene", "scene.json"});
    EXPECT_EQ(sound.exitCode, 0) << sound.out << sound.err;
    EXPECT_NE(sound.out.find("velocities given"), std::string::npos) << sound.out;
    EXPECT_TRUE(sound.out.ends_with("\nverdict           sound\n")) << sound.out;
  }
  writeKicked("kicked.csv", 10);
  const Ended broken = careen({"audit", "kicked.csv", "--scene", "scene.json", "--report", "audit.json"});
  EXPECT_EQ(broken.exitCode, 4) << broken.out;
  EXPECT_NE(broken.out.find("BROKEN            at 0.1 s crate: unexplained linear momentum"),
            std::string::npos)
      << broken.out;
  const nlohmann::json report = nlohmann::json::parse(textOf(folder_ / "audit.json"));
  EXPECT_EQ(report["breaches"][0]["kind"], "linear_momentum");
  EXPECT_EQ(report["method"], "given poses");
  EXPECT_EQ(careen({"audit", "kicked.csv", "--scene", "scene.json", "--tolerance", "0.2"}).exitCode, 0);
  EXPECT_EQ(careen({"audit", "kicked.csv", "--scene", "scene.json", "--allow",
                    "linear_momentum=1,angular_momentum=any,energy_rise=1"})
                .exitCode,
            0);
  // careen's own, too, by what their method promises.
  EXPECT_EQ(careen({"audit", "run.careen"}).exitCode, 0);
}

TEST_F(GivenRuns, badUseOfTheAuditIsTold) {
  const auto refusal = [this](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "audit");
    const Ended ended = careen(std::move(arguments));
    EXPECT_EQ(ended.exitCode, 2);
    return ended.err;
  };
  EXPECT_NE(refusal({"run.csv"}).find("expected --scene"), std::string::npos);
  EXPECT_NE(refusal({"scene.json"}).find("expected a trajectory file or a table of poses"),
            std::string::npos);
  EXPECT_NE(refusal({"run.careen", "--scene", "scene.json"}).find("which has its scene"), std::string::npos);
  EXPECT_NE(refusal({"run.careen", "--tolerance", "0.1"}).find("expected a table of poses"),
            std::string::npos);
  EXPECT_NE(refusal({"run.csv", "--scene", "scene.json", "--allow", "luck=1"}).find("found 'luck'"),
            std::string::npos);
  EXPECT_NE(refusal({"run.csv", "--scene", "scene.json", "--allow", "energy_rise=x"}).find("KIND=SIZE"),
            std::string::npos);
  EXPECT_NE(refusal({"run.csv", "--scene", "scene.json", "--tolerance", "2"}).find("expected a part"),
            std::string::npos);
  refusal({"nowhere.csv", "--scene", "scene.json"});
  folder_.write("cut.csv", textOf(folder_ / "run.csv").substr(0, 1000));
  EXPECT_NE(refusal({"cut.csv", "--scene", "scene.json"}).find("; the file may be cut short"),
            std::string::npos);
}

TEST_F(GivenRuns, areComparedFromWhenByHowMuchAndWhatBrokeFirst) {
  for (const char* const table : {"run.csv", "run.npz"}) {
    const Ended same = careen({"compare", "run.careen", table});
    EXPECT_EQ(same.exitCode, 0) << same.out << same.err;
    EXPECT_EQ(careen({"compare", table, "run.careen"}).exitCode, 0);
  }
  EXPECT_EQ(careen({"compare", "run.csv", "run.npz", "--scene", "scene.json"}).exitCode, 0);
  EXPECT_EQ(careen({"compare", "run.csv", "run.npz"}).exitCode, 2);
  writeKicked("kicked.csv", 75);
  const Ended differs = careen({"compare", "run.careen", "kicked.csv", "--out", "report"});
  EXPECT_EQ(differs.exitCode, 1);
  EXPECT_NE(differs.out.find("other motion from 0.75 s on, after impact number "), std::string::npos)
      << differs.out;
  EXPECT_NE(differs.out.find("broken first, at 0.7"), std::string::npos) << differs.out;
  const nlohmann::json report = nlohmann::json::parse(textOf(folder_ / "report/report.json"));
  EXPECT_EQ(report["run"]["first_time"], 0.75);
  EXPECT_TRUE(report["run"]["first_broken"].is_string());
  EXPECT_TRUE(report["run"]["last_impact"]["expected"]["time"].is_number());
  EXPECT_EQ(careen({"compare", "run.careen", "kicked.csv", "--motion", "0.005", "--until", "0.76"}).exitCode,
            0);
  EXPECT_EQ(careen({"compare", "run.careen", "run.careen", "--scene", "scene.json"}).exitCode, 2);
}

TEST_F(GivenRuns, takePartInTheStudy) {
  const Ended ended = careen({"study", "scene.json", "--quick", "--methods", "exact", "--run", "run.csv",
                              "--label", "my engine", "--seconds", "0.5", "--no-plots"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const nlohmann::json results = nlohmann::json::parse(textOf(folder_ / "study/results.json"));
  const nlohmann::json& mine = results["cases"][0]["attempts"].back();
  EXPECT_EQ(mine["contestant"], "my engine");
  EXPECT_FALSE(mine.contains("failure"));
  EXPECT_LT(mine["error"], 0.02);  // interpolated across impacts; measured 0.008
  EXPECT_GT(mine["cost_us"], 0);
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"study", "scene.json", "--run", "run.csv"},
        {"study", "--run", "run.csv", "--label", "x"},
        {"study", "scene.json", "--run", "run.csv", "--label", "exact"},
        {"study", "scene.json", "--run", "run.csv", "--label", "x", "--seconds", "soon"}}) {
    EXPECT_EQ(careen(wrong).exitCode, 2) << wrong.back();
  }
}

TEST_F(GivenRuns, infoTellsWhatTheyAre) {
  const Ended ended = careen({"info", "run.npz", "--scene", "scene.json"});
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("given poses"), std::string::npos) << ended.out;
}

TEST_F(GivenRuns, npzIsAnOutputLikeOthers) {
  EXPECT_EQ(careen({"simulate", "scene.json", "--npz", "scene.json"}).exitCode, 2);
  EXPECT_EQ(careen({"simulate", "scene.json", "--every", "0.1"}).exitCode, 2);
  EXPECT_TRUE(textOf(folder_ / "run.npz").starts_with("PK"));
}

// It tumbles and lands between two rows, where a cubic through them would be 7 mm behind the wall.
TEST_F(GivenRuns, anExactRunAsATableOfFewRowsIsAuditedAtThem) {
  folder_.write("fall.json", R"({
    "careen": 1, "duration": 1.5, "gravity": [1, 0.5, -9],
    "walls": [ { "name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1], "friction": 0.4 } ],
    "boxes": [ { "half_extents": [0.12966058179601558, 0.14822047051272494, 0.14904093304985672],
                 "position": [-0.08740593326887858, -0.6485147773826307, 1.445692713873119],
                 "mass": 2.864424136243376,
                 "angular_velocity": [-2.1494946941305053, -2.2399735882697436, 4.6161264687740005] } ] })");
  ASSERT_EQ(careen({"simulate", "fall.json", "-o", "fall.careen", "--poses", "fall.csv"}).exitCode, 0);
  const Ended ended = careen({"audit", "fall.csv", "--scene", "fall.json"});
  EXPECT_EQ(ended.exitCode, 0) << ended.out << ended.err;
}

// The run at another time of the clock, in whole seconds so that differences of times stay what they were to
// within 1e-7 s.
TEST_F(GivenRuns, clocksThatBeganElsewhereAreToldAndShifted) {
  const auto writeLater = [this](const std::string& name, double by) {
    std::istringstream lines(textOf(folder_ / "run.csv"));
    std::ostringstream text;
    text.precision(17);
    std::string line;
    std::getline(lines, line);
    text << line << '\n';
    while (std::getline(lines, line)) {
      const std::size_t comma = line.find(',');
      text << std::stod(line.substr(0, comma)) + by << line.substr(comma) << '\n';
    }
    folder_.write(name, text.str());
  };
  writeLater("late.csv", 100);
  writeLater("unix.csv", 1403636579);
  const Ended late = careen({"audit", "late.csv", "--scene", "scene.json"});
  EXPECT_EQ(late.exitCode, 2);
  EXPECT_NE(late.err.find("late.csv: found a first row at 100 s, expected one within the scene's 1 s; "
                          "--shift-time counts from the first row"),
            std::string::npos)
      << late.err;
  const Ended epoch = careen({"compare", "run.careen", "unix.csv"});
  EXPECT_EQ(epoch.exitCode, 2);
  EXPECT_NE(epoch.err.find("unix.csv: found a first row at 1403636579 s"), std::string::npos) << epoch.err;
  for (const char* const table : {"late.csv", "unix.csv"}) {
    const Ended shifted = careen({"audit", table, "--scene", "scene.json", "--shift-time"});
    EXPECT_EQ(shifted.exitCode, 0) << shifted.out << shifted.err;
    const Ended same = careen({"compare", "run.careen", table, "--shift-time", "--motion", "1e-5"});
    EXPECT_EQ(same.exitCode, 0) << same.out << same.err;
  }
  folder_.write("short.csv",
                "time,box,x,y,z,qw,qx,qy,qz\n0.7,crate,0,0,1,1,0,0,0\n0.8,crate,0,0,1,1,0,0,0\n");
  const Ended note = careen({"info", "short.csv", "--scene", "scene.json"});
  EXPECT_EQ(note.exitCode, 0) << note.err;
  EXPECT_NE(note.err.find("short.csv: its first row is at 0.7 s; until then"), std::string::npos) << note.err;
}

TEST_F(GivenRuns, timesAreShiftedOfTablesOnly) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"info", "scene.json"},
                                                    {"audit", "run.careen"},
                                                    {"compare", "run.careen", "run.careen"}}) {
    std::vector<std::string> all = arguments;
    all.emplace_back("--shift-time");
    const Ended ended = careen(all);
    EXPECT_EQ(ended.exitCode, 2) << ended.out;
    EXPECT_NE(ended.err.find("--shift-time: found "), std::string::npos) << ended.err;
  }
}

}  // namespace
}  // namespace careen
