// What is told of a simulation while it goes on.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/process.h"
#include "support/program.h"

namespace careen {
namespace {

class ProgressOfRuns : public testing::Test {
 protected:
  // A hundred boxes that fly about for so many seconds, with some 900 records in each.
  void writeGas(const std::string& duration) const {
    const std::string key = "\"duration\": ";
    std::string text = textOf(CAREEN_SOURCE_DIR "/assets/scenes/gas.json");
    const std::size_t at = text.find(key) + key.size();
    folder_.write("gas.json", text.replace(at, text.find(',', at) - at, duration));
  }
  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program());
    return Process(arguments, folder_.path()).wait();
  }
  // What it prints on a terminal.
  std::string onTerminal(const std::string& arguments) const {
    const std::string command = program() + " " + arguments;
    EXPECT_EQ(Process({"script", "-qec", command, "terminal"}, folder_.path()).wait().exitCode, 0);
    const std::string text = textOf(folder_ / "terminal");  // between two lines of script's own
    const std::size_t begin = text.starts_with("Script ") ? text.find('\n') + 1 : 0;
    return text.substr(begin, text.rfind("\nScript ") - begin);
  }
  TemporaryFolder folder_;
};

TEST_F(ProgressOfRuns, isLoggedAsLinesOfJsonAtMostEveryHalfSecond) {
  writeGas("60");
  const Ended ended = careen({"simulate", "gas.json", "--log", "json"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_TRUE(ended.err.find("\nfiles        gas.careen\n") != std::string::npos) << ended.err;
  std::istringstream lines(ended.out);
  std::vector<nlohmann::json> told;
  for (std::string line; std::getline(lines, line);) {
    if (const nlohmann::json now = nlohmann::json::parse(line); now["phase"] == "simulate") {
      told.push_back(now);
    }
  }
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.back()["simulated"], 60);
  EXPECT_EQ(told.back()["seconds_left"], 0);
  EXPECT_EQ(told.back()["flying"], 100);
  EXPECT_EQ(told.back()["touching"], 0);
  EXPECT_LE(static_cast<double>(told.size()), 1 + told.back()["seconds"].get<double>() / 0.5);
  for (std::size_t k = 1; k < told.size(); ++k) {
    EXPECT_GE(told[k]["simulated"], told[k - 1]["simulated"]);
    EXPECT_GE(told[k]["impacts"], told[k - 1]["impacts"]);
    EXPECT_GT(told[k]["records"], told[k]["impacts"]);
  }
}

TEST_F(ProgressOfRuns, isOneLineOfATerminalThatIsGoneInTheEnd) {
  writeGas("60");
  const std::string all = onTerminal("simulate gas.json --no-estimate-error");
  const std::string shown = all.substr(0, all.find("scene        gas"));
  EXPECT_TRUE(shown.starts_with("\rsimulated ")) << all;
  EXPECT_NE(shown.find(" of 60 s, "), std::string::npos) << all;
  EXPECT_NE(shown.find(" left, "), std::string::npos) << all;
  EXPECT_NE(shown.find(", 100 fly"), std::string::npos) << all;
  EXPECT_EQ(shown.find('\n'), std::string::npos) << all;
  ASSERT_GE(shown.size(), 2U);
  const std::size_t last = shown.rfind('\r', shown.size() - 2);
  EXPECT_EQ(shown.find_first_not_of(' ', last + 1), shown.size() - 1) << all;
  EXPECT_EQ(shown.back(), '\r');
  EXPECT_TRUE(onTerminal("dice --throws 60 --threads 1 --no-plots").starts_with("\rthrown "));
}

TEST_F(ProgressOfRuns, elsewhereNothingIsShown) {
  writeGas("60");
  const Ended ended = careen({"simulate", "gas.json"});
  EXPECT_EQ(ended.exitCode, 0);
  EXPECT_EQ(ended.err, "");
  EXPECT_EQ(careen({"dice", "--throws", "20", "--no-plots"}).err, "");
}

TEST_F(ProgressOfRuns, warnsLongBeforeTheLimit) {
  writeGas("10000");
  const Ended ended = careen({"simulate", "gas.json", "--limit", "100000"});
  EXPECT_EQ(ended.exitCode, 2);
  const std::size_t warning = ended.err.find("careen: at this rate the run will end in an error ");
  const std::size_t error = ended.err.find("careen: the run takes more than 100000 pieces of motion");
  ASSERT_NE(warning, std::string::npos) << ended.err;
  ASSERT_NE(error, std::string::npos) << ended.err;
  EXPECT_LT(warning, error);
  EXPECT_EQ(ended.err.find("at this rate", warning + 20), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace careen
