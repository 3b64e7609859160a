// The program as its user meets it: what it prints, what it leaves behind, how it ends.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/process.h"
#include "support/program.h"

namespace careen {
namespace {

const std::string kScene = R"({
  "careen": 1, "name": "bounce", "duration": 1, "gravity": [0, 0, -10], "method": "listing1", "dt": 0.001,
  "room": { "min": [-2, -2, 0], "max": [2, 2, 4], "restitution": 1 },
  "boxes": [ { "name": "crate", "half_extents": [0.3, 0.2, 0.1], "mass": 1, "position": [0, 0, 1],
               "orientation": { "axis": [1, 2, 3], "angle_deg": 40 } } ]
})";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

class CommandLine : public testing::Test {
 protected:
  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program());
    return Process(arguments, folder_.path()).wait();
  }
  std::vector<std::string> linesOf(const std::string& name) const {
    std::istringstream stream(textOf(folder_ / name));
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) {
      lines.push_back(line);
    }
    return lines;
  }

  TemporaryFolder folder_;
};

TEST_F(CommandLine, explainsItself) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"--help"}, {"simulate", "--help"}, {"info", "--help"}}) {
    const Ended ended = careen(arguments);
    EXPECT_EQ(ended.exitCode, 0);
    EXPECT_NE(ended.out.find("Usage"), std::string::npos) << ended.out;
  }
}

TEST_F(CommandLine, helpIsTheSameWithEveryVersionOfCli11) {
  EXPECT_EQ(careen({"verify", "--help"}).out, R"(Which frames of a film are missing or broken
Usage: careen verify [OPTIONS] folder

Positionals:
  folder TEXT REQUIRED        Folder of frames

Options:
  -h,--help                   Print this help message and exit

)");
}

TEST_F(CommandLine, refusesWhatItDoesNotKnow) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"fly"},
                                             {"simulate", "--fast"},
                                             {"simulate", "--dt"},
                                             {"simulate", "--dt", "soon"},
                                             {"simulate", "--dt", "-1"},
                                             {"simulate", "--dt", "nan"},
                                             {"simulate", "--duration", "0"},
                                             {"simulate", "--tolerance", "0"},
                                             {"simulate", "--dt", "0.01"},
                                             {"simulate", "--method", "listing1", "--tolerance", "1e-9"},
                                             {"simulate", "--method", "guess"},
                                             {"simulate", "a.json", "b.json"}}) {
    const Ended ended = careen(arguments);
    EXPECT_EQ(ended.exitCode, 2) << ended.err;
    EXPECT_FALSE(ended.err.empty());
    EXPECT_TRUE(folder_.files().empty());
  }
}

TEST_F(CommandLine, simulatesAndWritesTheTables) {
  folder_.write("scene.json", kScene);
  const Ended ended = careen({"simulate", "--poses", "poses.csv", "--every", "0.1", "scene.json", "--impacts",
                              "impacts.csv", "-o", "run.careen", "--report", "report.json"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(folder_.files(), (std::vector<std::string>{"impacts.csv", "poses.csv", "report.json",
                                                       "run.careen", "scene.json"}));
  const std::vector<std::string> poses = linesOf("poses.csv");
  ASSERT_EQ(poses.size(), 1U + 11U);
  EXPECT_EQ(poses[0], "time,box,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz");
  EXPECT_TRUE(poses[1].starts_with("0,crate,0,0,1,")) << poses[1];
  const std::vector<std::string> impacts = linesOf("impacts.csv");
  EXPECT_EQ(impacts.at(0), "time,a,b,x,y,z,nx,ny,nz,approach,impulse,tangential");
  ASSERT_GT(impacts.size(), 1U);
  EXPECT_NE(impacts[1].find(",crate,room-z,"), std::string::npos) << impacts[1];
}

TEST_F(CommandLine, reportHasTheKeysOfTheContract) {
  folder_.write("scene.json", kScene);
  ASSERT_EQ(careen({"simulate", "scene.json", "--report", "report.json"}).exitCode, 0);
  const nlohmann::json report = nlohmann::json::parse(textOf(folder_ / "report.json"));
  for (const char* key : {"scene", "scene_hash", "method", "dt", "simulated_seconds", "wall_seconds",
                          "impacts", "state_hash", "energy_change", "momentum_change", "orthogonality",
                          "deepest_penetration", "life", "modelled", "left_out"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(report["scene"], "bounce");
  EXPECT_EQ(report["simulated_seconds"], 1.0);
  EXPECT_GT(report["impacts"], 0);
  EXPECT_TRUE(report["modelled"].is_array());
}

// A cube slides with another on it.
TEST_F(CommandLine, reportsTheResidualsOfContact) {
  folder_.write("scene.json", R"({ "careen": 1, "duration": 1, "gravity": [0, 0, -10],
    "walls": [ { "name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1], "friction": 0.5 } ],
    "boxes": [ { "name": "lower", "half_extents": [0.5, 0.5, 0.5], "mass": 1, "position": [0, 0, 0.5],
                 "velocity": [1, 0, 0], "friction": 0.5 },
               { "name": "upper", "half_extents": [0.5, 0.5, 0.5], "mass": 1, "position": [0, 0, 1.5],
                 "friction": 0.5 } ] })");
  const Ended ended = careen({"simulate", "scene.json", "--report", "report.json", "--verbose"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("\nresiduals    primal "), std::string::npos) << ended.out;
  const nlohmann::json report = nlohmann::json::parse(textOf(folder_ / "report.json"));
  const nlohmann::json& exact = report.at("contact_residuals").at("exact");
  EXPECT_GT(exact.at("problems"), 0);
  for (const char* const key : {"primal", "dual", "complementarity"}) {
    EXPECT_GE(exact.at(key), 0) << key;
    EXPECT_LT(exact.at(key), 1e-6) << key;  // measured 4e-8: time steps are solved as the tolerance needs
  }
  EXPECT_EQ(report.at("contact_residuals").at("crowds").at("problems"), 0);
}

// The words that lines begin with.
std::vector<std::string> beginningsOf(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    words.push_back(line.substr(0, line.find("  ")));
  }
  return words;
}

TEST_F(CommandLine, summaryIsWhatANewUserNeeds) {
  const std::string rough = replaced(kScene, R"("restitution": 1)", R"("restitution": 1, "friction": 0.5)");
  folder_.write("scene.json", replaced(rough, R"("orientation")", R"("friction": 0.5, "orientation")"));
  const Ended other = careen({"simulate", "scene.json", "--no-estimate-error", "--impacts", "impacts.csv"});
  ASSERT_EQ(other.exitCode, 0) << other.err;
  // What the scene needs and the method lacks is told, not what the scene has none of.
  EXPECT_EQ(beginningsOf(other.out),
            (std::vector<std::string>{"scene", "left out", "left out", "motion", "error", "speed", "files"}));
  EXPECT_NE(other.out.find("; audit: keeps what its method promises\n"), std::string::npos) << other.out;
  EXPECT_NE(other.out.find("\nfiles        scene.careen, impacts.csv\n"), std::string::npos) << other.out;
  const Ended exact = careen({"simulate", "scene.json", "--method", "exact", "--estimate-error"});
  ASSERT_EQ(exact.exitCode, 0) << exact.err;
  EXPECT_EQ(beginningsOf(exact.out),
            (std::vector<std::string>{"scene", "motion", "error", "estimate", "speed", "files"}));
  // All of it is in the long one, and more.
  const Ended more = careen({"simulate", "scene.json", "--method", "exact", "--verbose"});
  for (const char* const row : {"modelled", "life", "impacts", "state hash", "files"}) {
    EXPECT_NE(more.out.find(std::string("\n") + row + "  "), std::string::npos) << row << more.out;
  }
}

TEST_F(CommandLine, sameSceneGivesTheSameBytes) {
  folder_.write("scene.json", kScene);
  ASSERT_EQ(careen({"simulate", "scene.json", "-o", "a.careen"}).exitCode, 0);
  ASSERT_EQ(careen({"simulate", "scene.json", "-o", "b.careen"}).exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "a.careen"), textOf(folder_ / "b.careen"));
}

TEST_F(CommandLine, announcesWhatItOverrides) {
  folder_.write("scene.json", kScene);
  const Ended ended = careen({"simulate", "scene.json", "--duration", "0.5", "--report", "report.json"});
  ASSERT_EQ(ended.exitCode, 0);
  EXPECT_NE(ended.err.find("duration 0.5 from the command line (the scene says 1)"), std::string::npos)
      << ended.err;
  EXPECT_EQ(nlohmann::json::parse(textOf(folder_ / "report.json"))["simulated_seconds"], 0.5);
}

TEST_F(CommandLine, boxesThatOverlapAreNoSceneForAMethodThatLetsThemMeet) {
  folder_.write("scene.json", R"({ "careen": 1, "duration": 1, "method": "listing1", "boxes": [
    { "name": "a", "half_extents": [1, 1, 1], "mass": 1 }, { "name": "b", "half_extents": [1, 1, 1], "mass": 1 } ] })");
  EXPECT_EQ(careen({"simulate", "scene.json", "-o", "run.careen"}).exitCode, 0);
  const Ended ended = careen({"simulate", "scene.json", "--method", "exact"});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_NE(ended.err.find("box b starts 2 m inside box a; expected boxes apart"), std::string::npos)
      << ended.err;
}

const char* const kOverlap = R"({ "careen": 1, "duration": 0.1,
  "walls": [ { "name": "ground", "point": [0, 0, 0], "normal": [0, 0, 1] } ], "boxes": [
  { "name": "a", "half_extents": [1, 1, 1], "mass": 1, "position": [0, 0, 0.875] },
  { "name": "b", "half_extents": [1, 1, 1], "mass": 3, "position": [1.5, 0, 4] },
  { "name": "c", "half_extents": [1, 1, 1], "mass": 1, "position": [1.5, 0, 5.5], "velocity": [0, 0, 1] } ] })";

// The lower moves by 0.125 m out of the ground; the others, of masses 3 and 1, by 0.125 m and 0.375 m.
TEST_F(CommandLine, boxesThatOverlapAreMovedApartIfTheyMay) {
  folder_.write("scene.json", kOverlap);
  EXPECT_EQ(careen({"simulate", "scene.json"}).exitCode, 2);
  const Ended ended = careen({"simulate", "scene.json", "--allow-overlap", "--poses", "poses.csv"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.err.find("moved apart 1 pair of boxes that overlapped and 1 box behind walls: "
                           "3 boxes by at most 0.375 m"),
            std::string::npos)
      << ended.err;
  const std::string poses = textOf(folder_ / "poses.csv");
  const auto heightAtStart = [&](const std::string& box) {
    std::istringstream row(poses.substr(poses.find("\n0," + box + ",") + 5));
    double x = 0;
    double y = 0;
    double z = 0;
    char comma = ' ';
    row >> x >> comma >> y >> comma >> z;
    return z;
  };
  EXPECT_NEAR(heightAtStart("a"), 1, 1e-12) << poses;
  EXPECT_NEAR(heightAtStart("b"), 3.875, 1e-12) << poses;
  EXPECT_NEAR(heightAtStart("c"), 5.875, 1e-12) << poses;
  EXPECT_NE(poses.find(",1,0,0,0,0,0,1,"), std::string::npos) << poses;
  // What was moved is told by the trajectory, which needs no leave to be read.
  const Ended info = careen({"info", "scene.careen"});
  EXPECT_EQ(info.exitCode, 0) << info.err;
}

TEST_F(CommandLine, boxesWithoutRoomToPartAreNoScene) {
  folder_.write("scene.json",
                R"({ "careen": 1, "duration": 1, "room": { "min": [0, 0, 0], "max": [3, 3, 3] }, "boxes": [
    { "name": "a", "half_extents": [1, 1, 1], "mass": 1, "position": [1, 1, 1] },
    { "name": "b", "half_extents": [1, 1, 1], "mass": 1, "position": [2, 2, 2] } ] })");
  const Ended ended = careen({"simulate", "scene.json", "--allow-overlap"});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_NE(ended.err.find("cannot be moved out of"), std::string::npos) << ended.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "scene.careen"));
}

TEST_F(CommandLine, toleranceIsReportedByAMethodThatChoosesItsOwnSteps) {
  folder_.write("scene.json",
                R"({ "careen": 1, "duration": 1, "boxes": [ { "half_extents": [1, 1, 1], "mass": 1 } ] })");
  const Ended ended = careen({"simulate", "scene.json", "--tolerance", "1e-9", "--report", "report.json"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.err.find("tolerance 1e-09 from the command line (the scene says 1e-06)"), std::string::npos)
      << ended.err;
  const nlohmann::json report = nlohmann::json::parse(textOf(folder_ / "report.json"));
  EXPECT_EQ(report["tolerance"], 1e-9);
  EXPECT_FALSE(report.contains("dt"));
}

TEST_F(CommandLine, infoTellsWhatIsLeftOutAndWhy) {
  folder_.write("scene.json", kScene);
  const Ended ended = careen({"info", "scene.json"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const std::size_t leftOut = ended.out.find("left out");
  ASSERT_NE(leftOut, std::string::npos) << ended.out;
  EXPECT_LT(ended.out.find("gravity"), leftOut);
  EXPECT_NE(ended.out.find("box-box", leftOut), std::string::npos) << ended.out;
}

TEST_F(CommandLine, infoTellsWhichBoxesMayGoOnAsACrowd) {
  const auto infoOf = [&](const std::string& more) {
    folder_.write("scene.json",
                  R"({ "careen": 1, "duration": 1, "boxes": [ { "half_extents": [1, 1, 1], "mass": 1 } ])" +
                      more + " }");
    const Ended ended = careen({"info", "scene.json"});
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    return ended.out;
  };
  const std::string walls = R"(, "walls": [ { "point": [0, 0, -3], "normal": [0, 0, 1] } ])";
  const auto says = [](const std::string& out, const std::string& what) {
    return out.find(what) != std::string::npos;
  };
  EXPECT_FALSE(says(infoOf(""), "crowd"));
  EXPECT_TRUE(says(infoOf(walls), "crowd        where exact contact costs too much"));
  EXPECT_TRUE(says(infoOf(walls), "an error of about 0.0003 m"));
  EXPECT_TRUE(says(infoOf(walls + R"(, "crowds": { "when": 20 })"), "more than 20 boxes touch and move"));
  EXPECT_TRUE(says(infoOf(walls + R"(, "crowds": { "when": "never" })"), "crowd        never"));
  EXPECT_FALSE(says(infoOf(walls + R"(, "method": "listing1")"), "crowd"));
}

TEST_F(CommandLine, infoListsJoints) {
  folder_.write("scene.json", R"({ "careen": 1, "duration": 1,
    "boxes": [ { "name": "crate", "half_extents": [1, 1, 1], "mass": 1 },
               { "name": "lid", "half_extents": [1, 1, 0.1], "mass": 1, "position": [0, 0, 1.1] } ],
    "joints": [ { "name": "hinge", "type": "hinge", "between": ["lid", "crate"], "at": [1, 0, 1],
                  "axis": [0, 1, 0], "range": [-0.5, 2], "damping": 0.5, "spring": { "stiffness": 20 },
                  "friction": 1.5 },
                { "name": "spin", "type": "hinge", "between": ["crate", "world"], "at": [0, 0, -1],
                  "axis": [0, 0, 1], "drive": { "speed": -3, "max": 7 } },
                { "type": "rope", "between": ["world", "lid"], "points": [[0, 0, 5], [0, 0, 0]],
                  "length": 4, "until": 0.5 } ],
    "control": { "period": 0.1, "motors": [ { "joint": "hinge", "target": 1, "kp": 2, "max": 40 } ] } })");
  const std::string out = careen({"info", "scene.json"}).out;
  EXPECT_NE(
      out.find("joint        hinge: hinge between lid and crate, from -0.5 to 2 rad, spring 20 N m/rad, "
               "damping 0.5 N m s/rad, friction 1.5 N m, motor up to 40 N m\n"
               "joint        spin: hinge between crate and the world, driven at -3 rad/s by up to 7 N m\n"
               "joint        joint-2: rope between lid and the world, 4 m long, until 0.5 s\n"
               "freedom      2 degrees of freedom of 2 boxes with joints at the start; no conditions of "
               "joints are redundant\n"),
      std::string::npos)
      << out;
}

TEST_F(CommandLine, infoReadsATrajectoryToo) {
  folder_.write("scene.json", kScene);
  ASSERT_EQ(careen({"simulate", "scene.json", "-o", "run.careen"}).exitCode, 0);
  const Ended ended = careen({"info", "run.careen"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("state hash"), std::string::npos) << ended.out;
}

TEST_F(CommandLine, everyCommandHasADefaultScene) {
  EXPECT_EQ(careen({"info"}).exitCode, 0);
  EXPECT_EQ(careen({"simulate"}).exitCode, 0);
  EXPECT_EQ(folder_.files(), std::vector<std::string>{"careen.careen"});
}

TEST_F(CommandLine, badScenesExitWith2AndWriteNothing) {
  const std::vector<std::pair<std::string, std::string>> changes = {
      {"\"careen\": 1", "\"careen\": 2"},
      {"\"duration\": 1", "\"duration\": 1e400"},
      {"\"duration\": 1", "\"duration\": NaN"},
      {"\"duration\": 1", R"("duration": "1")"},
      {"\"mass\": 1", "\"mass\": 0"},
      {"\"mass\": 1", "\"mass\": -1"},
      {"\"mass\": 1", "\"mas\": 1"},
      {"[0.3, 0.2, 0.1]", "[0.3, 0, 0.1]"},
      {"[0, 0, 1]", "[0, 0, 0.1]"},
      {"[0, 0, 1]", "[0, 0, -9]"},
      {"}", "} }"},
  };
  for (const auto& [from, to] : changes) {
    folder_.write("scene.json", replaced(kScene, from, to));
    const Ended ended = careen({"simulate", "scene.json", "--poses", "p.csv", "--impacts", "i.csv"});
    EXPECT_EQ(ended.exitCode, 2) << to << ": " << ended.err;
    EXPECT_NE(ended.err.find("scene.json:"), std::string::npos) << ended.err;
    EXPECT_EQ(folder_.files(), std::vector<std::string>{"scene.json"}) << to;
  }
}

TEST_F(CommandLine, missingFileAndFolderInItsPlaceAreNamed) {
  const Ended missing = careen({"simulate", "nowhere.json"});
  EXPECT_EQ(missing.exitCode, 2);
  EXPECT_NE(missing.err.find("nowhere.json"), std::string::npos) << missing.err;
  std::filesystem::create_directory(folder_ / "folder.json");
  const Ended folder = careen({"simulate", "folder.json"});
  EXPECT_EQ(folder.exitCode, 2);
  EXPECT_NE(folder.err.find("is a folder"), std::string::npos) << folder.err;
}

TEST_F(CommandLine, placesThatCannotBeWrittenExitWith3) {
  folder_.write("scene.json", kScene);
  const Ended ended = careen({"simulate", "scene.json", "-o", "no/such/folder/run.careen"});
  EXPECT_EQ(ended.exitCode, 3);
  EXPECT_NE(ended.err.find("no/such/folder/run.careen: cannot be written"), std::string::npos) << ended.err;
}

// A file may grow to 8 blocks of 1 kB, as on a disk that is nearly full.
TEST_F(CommandLine, fullDiskLeavesNoneOfTheFiles) {
  folder_.write("scene.json", kScene);
  const Ended ended = Process({"bash", "-c",
                               std::string("trap '' XFSZ; ulimit -f 8; exec ") + program() +
                                   " simulate scene.json -o run.careen --impacts i.csv --poses p.csv"},
                              folder_.path())
                          .wait();
  EXPECT_EQ(ended.exitCode, 3) << ended.err;
  EXPECT_NE(ended.err.find("cannot be written"), std::string::npos) << ended.err;
  EXPECT_EQ(folder_.files(), std::vector<std::string>{"scene.json"});
}

// A cube falls flat with e = 0: the 1997 method cannot rest.
TEST_F(CommandLine, methodThatCannotGoOnExitsWith4AndWritesNothing) {
  folder_.write("scene.json", R"({ "careen": 1, "duration": 2, "gravity": [0, 0, -10], "method": "listing1",
    "dt": 0.016666666666666666, "room": { "min": [-2, -2, 0], "max": [2, 2, 4] },
    "boxes": [ { "half_extents": [0.5, 0.5, 0.5], "mass": 1, "position": [0, 0, 1] } ] })");
  const Ended ended = careen({"simulate", "scene.json", "--impacts", "i.csv"});
  EXPECT_EQ(ended.exitCode, 4) << ended.err;
  EXPECT_FALSE(ended.err.empty());
  EXPECT_EQ(folder_.files(), std::vector<std::string>{"scene.json"});
}

TEST_F(CommandLine, interruptedSimulationWritesNothing) {
  folder_.write("scene.json", replaced(kScene, "\"duration\": 1,", "\"duration\": 100000,"));
  for (const int signal : {SIGINT, SIGTERM}) {
    Process process({program(), "simulate", "scene.json", "-o", "run.careen"}, folder_.path());
    process.sendOnceMasked(signal);
    const Ended ended = process.wait();
    EXPECT_EQ(ended.signal, signal) << ended.exitCode << ended.err;
    EXPECT_NE(ended.err.find("interrupted"), std::string::npos);
    EXPECT_EQ(folder_.files(), std::vector<std::string>{"scene.json"});
  }
}

// Reading a pipe into which nobody writes never ends, whatever the stop request.
TEST_F(CommandLine, obeysTheFirstSignalEvenWhereItWaitsForever) {
  ASSERT_EQ(mkfifo((folder_ / "pipe.json").c_str(), 0600), 0);
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"simulate", "pipe.json"}, {"info", "pipe.json"}}) {
    std::vector<std::string> command = {program()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    Process process(command, folder_.path());
    process.sendOnceMasked(SIGTERM);
    const Ended ended = process.wait();
    EXPECT_EQ(ended.signal, SIGTERM) << ended.exitCode << ended.err;
    EXPECT_EQ(ended.err, "careen: interrupted\n");
    EXPECT_EQ(folder_.files(), std::vector<std::string>{"pipe.json"});
  }
}

// As a shell starts jobs in the background of a script.
TEST_F(CommandLine, keepsIgnoringAnIgnoredSignal) {
  folder_.write("scene.json", kScene);
  Process process({"bash", "-c", "trap '' INT; exec \"$0\" simulate scene.json --duration 100000", program()},
                  folder_.path());
  process.waitUntilItMasks(SIGTERM);
  process.send(SIGINT);  // which would be taken first
  process.send(SIGTERM);
  EXPECT_EQ(process.wait().signal, SIGTERM);
}

}  // namespace
}  // namespace careen
