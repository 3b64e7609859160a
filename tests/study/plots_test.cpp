// What study.h declares of files: tables and plots.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/system/file.h"
#include "some_case.h"
#include "study/study.h"
#include "support/environment_variable.h"
#include "support/process.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

StudyResult plottedStudy() { return {.machine = "here", .command = "careen study", .cases = {someCase()}}; }

TEST(Plots, areMadeFromTablesThatAreAllWritten) {
  const TemporaryFolder folder;
  writeTables(plottedStudy(), folder.path());
  EXPECT_EQ(folder.files(), (std::vector<std::string>{"energy.csv", "matrix.csv", "results.csv",
                                                      "results.json", "results.md"}));
  EXPECT_EQ(readFile(folder / "matrix.csv"), matrixCsv(plottedStudy()));
}

TEST(Plots, areDrawnOfTheMatrixOfEachCaseAndOfItsEnergy) {
  const TemporaryFolder folder;
  StudyResult study = plottedStudy();
  study.cases.push_back(someCase());
  study.cases[1].name = "lost";
  study.cases[1].attempts = {failed("ode", 0.1)};
  writeTables(study, folder.path());
  checkPlotter();
  const std::vector<std::string> plots = drawPlots(study, folder.path());
  ASSERT_EQ(plots.size(), 2U);
  EXPECT_NE(plots[0].find("strang"), std::string::npos);
  EXPECT_EQ(plots[0].find("ode"), std::string::npos) << "it has no answer";
  EXPECT_EQ(plots[1], "") << "nobody has an answer";
  for (const char* const name : {"matrix", "tumble", "tumble-energy"}) {
    const fs::path plot = folder / "plots" / name;
    EXPECT_EQ(readFile(plot.string() + ".png").substr(1, 3), "PNG") << name;
    EXPECT_NE(readFile(plot.string() + ".svg").find("<svg"), std::string::npos) << name;
  }
}

// gnuplot reads "<command" from a program and writes "|command" to one.
TEST(Plots, takeNamesForNamesAndNotForCommands) {
  const TemporaryFolder folder;
  const std::string name = "a';system('touch made');'";
  const std::string title = "`touch made`, \"q\" it's {/:=40 100%} \\n\nend";
  for (const std::string out : {"|touch made", "< touch made", "it's", "a,\"b\"\nc", "-e", "$(touch made)"}) {
    StudyResult study = plottedStudy();
    study.cases[0].name = name;
    study.cases[0].title = title;
    fs::create_directories(folder / out);
    const std::vector<std::string> plots = drawPlots(study, folder / out);
    EXPECT_NE(plots.at(0).find("`touch made`, ”q” it's {/:=40 100%} \\n end"), std::string::npos) << plots[0];
    for (const std::string& plot : {std::string("matrix"), name, name + "-energy"}) {
      EXPECT_TRUE(fs::exists(folder / out / "plots" / (plot + ".png"))) << out;
    }
    EXPECT_NE(readFile(folder / out / "plots" / "matrix.svg").find("system('touch made')"),
              std::string::npos);
    EXPECT_FALSE(fs::exists(folder / "made")) << out;
    EXPECT_FALSE(fs::exists("made")) << out;
  }
}

TEST(Plots, sayWhatToInstallWhereTheyCannotBeDrawn) {
  const TemporaryFolder empty;
  const EnvironmentVariable path("PATH", empty.path().string());
  try {
    checkPlotter();
    ADD_FAILURE() << "gnuplot was found";
  } catch (const MachineError& error) {
    EXPECT_NE(std::string(error.what()).find("install gnuplot-nox, or give --no-plots"), std::string::npos);
  }
}

}  // namespace
}  // namespace careen
