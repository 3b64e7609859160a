// The command that measures, as its user meets it.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/copied_program.h"
#include "support/environment_variable.h"
#include "support/process.h"
#include "support/program.h"

namespace careen {
namespace {

const std::string kFallScene = R"({ "careen": 1, "name": "fall", "duration": 1, "gravity": [0, 0, -10],
  "room": { "min": [-2, -2, 0], "max": [2, 2, 4], "restitution": 1 },
  "boxes": [ { "half_extents": [0.3, 0.2, 0.1], "mass": 1, "position": [0, 0, 1], "angular_velocity": [1, 2, 3] } ] })";

class StudyCommand : public testing::Test {
 protected:
  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program());
    return Process(arguments, folder_.path()).wait();
  }
  nlohmann::json jsonOf(const std::string& name) const {
    return nlohmann::json::parse(textOf(folder_ / name));
  }

  TemporaryFolder folder_;
};

TEST_F(StudyCommand, doesOneCaseInSeconds) {
  const Ended ended =
      careen({"study", "free-fall", "--quick", "--methods", "taylor-8,exact", "--out", "found"});
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("[1/1] free-fall"), std::string::npos) << ended.out;
  const nlohmann::json results = jsonOf("found/results.json");
  EXPECT_EQ(results.at("command"), "careen study free-fall --methods taylor-8,exact --quick");
  const nlohmann::json& attempts = results.at("cases").at(0).at("attempts");
  ASSERT_EQ(attempts.size(), 4U);
  EXPECT_EQ(attempts.at(0).at("contestant"), "exact");
  EXPECT_LT(attempts.at(0).at("error"), 1e-12);  // measured 9e-14
  EXPECT_EQ(attempts.at(1).at("contestant"), "taylor-8");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "found/index.html"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "found/plots/free-fall.svg"));
}

TEST_F(StudyCommand, takesASceneOfOnesOwn) {
  folder_.write("my scene.json", kFallScene);
  const Ended ended = careen({"study", "my scene.json", "--quick", "--no-plots"});
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(jsonOf("study/results.json").at("cases").at(0).at("title"), "fall");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "study/plots"));
}

TEST_F(StudyCommand, refusesWhatItDoesNotKnow) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"study", "free-fly"},
       "found the unknown case 'free-fly', expected a scene file, .json, or one of: tumble-generic"},
      {{"study", "missing.json"}, "missing.json"},
      {{"study", "free-fall", "--methods", "euler"},
       "--methods: found 'euler', expected some of: exact, listing1"}};
  for (const auto& [arguments, message] : wrong) {
    std::vector<std::string> all = arguments;
    all.emplace_back("--no-plots");
    const Ended ended = careen(all);
    EXPECT_EQ(ended.exitCode, 2) << message;
    EXPECT_NE(ended.err.find(message), std::string::npos) << ended.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "study/index.html"));
  }
}

// gnuplot's system() runs any command.
TEST_F(StudyCommand, plotScriptsBesideTheProgramAreIgnoredUnlessTheEnvironmentNamesThem) {
  const CopiedProgram copy(program());
  copy.plant("assets/study/cases.json", R"(["planted"])");  // data, which may come from there
  copy.plantAll("assets/plots");
  copy.plant("assets/plots/style.gp", "system(\"touch '" + (folder_ / "made").string() + "'\")\n" +
                                          textOf(CAREEN_SOURCE_DIR "/assets/plots/style.gp"));
  folder_.write("fall.json", kFallScene);
  const auto study = [&] {
    const Ended ended =
        Process({copy.path(), "study", "fall.json", "--quick", "--methods", "exact"}, folder_.path()).wait();
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "study/plots/fall.svg"));
  };
  study();
  EXPECT_FALSE(std::filesystem::exists(folder_ / "made"));

  const EnvironmentVariable data("CAREEN_DATA", copy.data().string());
  study();
  EXPECT_TRUE(std::filesystem::exists(folder_ / "made"));
}

TEST_F(StudyCommand, overwritesNoPlotWithThatOfASceneOfTheSameName) {
  folder_.write("matrix.json", kFallScene);
  const Ended ended = careen({"study", "matrix.json", "--quick"});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_NE(ended.err.find("found a case named matrix, expected another name: plots/matrix.svg shows"),
            std::string::npos)
      << ended.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "study"));
}

TEST_F(StudyCommand, saysWhatPlotsNeed) {
  const Ended ended =
      Process({"/usr/bin/env", "PATH=/nowhere", program(), "study", "free-fall", "--quick"}, folder_.path())
          .wait();
  EXPECT_EQ(ended.exitCode, 3);
  EXPECT_NE(ended.err.find("install gnuplot-nox, or give --no-plots"), std::string::npos) << ended.err;
}

TEST_F(StudyCommand, listsItsCases) {
  const Ended ended = careen({"study", "--list"});
  EXPECT_EQ(ended.exitCode, 0);
  EXPECT_NE(ended.out.find("separatrix-1e-9"), std::string::npos);
}

TEST_F(StudyCommand, leavesNoHalfFinishedCaseWhenInterrupted) {
  Process process({program(), "study", "room-million", "--no-plots"}, folder_.path());
  for (int tries = 0; tries < 6000 && !std::filesystem::exists(folder_ / "study/cases"); ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  process.send(SIGINT);
  const Ended ended = process.wait();
  EXPECT_EQ(ended.signal, SIGINT);
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "study/cases"));
}

TEST_F(StudyCommand, runsTellTheirOwnErrorWhenAsked) {
  folder_.write("scene.json", kFallScene);
  Ended ended =
      careen({"simulate", "scene.json", "--estimate-error", "--report", "report.json", "--verbose"});
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("to the end (by a start one rounding error away and a tenth of the tolerance)"),
            std::string::npos)
      << ended.out;
  nlohmann::json estimate = jsonOf("report.json").at("error_estimate");
  EXPECT_EQ(estimate.at("until"), 1);
  EXPECT_TRUE(estimate.at("horizon").is_null());
  EXPECT_LT(estimate.at("position"), 1e-12);
  EXPECT_GT(estimate.at("position"), 0);

  ended = careen({"simulate", "scene.json", "--estimate-error", "--method", "listing1", "--dt", "0.01",
                  "--report", "report.json"});
  estimate = jsonOf("report.json").at("error_estimate");
  EXPECT_EQ(estimate.at("by"), "half the time step");
  EXPECT_LE(estimate.at("until"), estimate.at("horizon"));

  careen({"simulate", "scene.json", "--no-estimate-error", "--report", "report.json"});
  EXPECT_FALSE(jsonOf("report.json").contains("error_estimate"));
  EXPECT_EQ(careen({"simulate", "scene.json", "--estimate-error", "--no-estimate-error"}).exitCode, 2);
}

}  // namespace
}  // namespace careen
