// Thrown dice beside measured ones, as their user meets them.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/process.h"
#include "support/program.h"

namespace careen {
namespace {

class Dice : public testing::Test {
 protected:
  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {program(), "dice"});
    return Process(arguments, folder_.path()).wait();
  }

  TemporaryFolder folder_;
};

TEST_F(Dice, writeTablesOfEverySetting) {
  const Ended ended = careen({"--throws", "3", "--friction", "0.3,0.1", "--spin", "40,20", "--out", "found"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("restitution 0.5, friction 0.1, 0.2 m, 1 m/s, 40 rad/s: "), std::string::npos)
      << ended.out;
  const std::string csv = textOf(folder_ / "found/dice.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3 * 15);
  EXPECT_NE(textOf(folder_ / "found/dice.md").find("| 0.5 | 0.3 | 0.2 | 1 | 20 | "), std::string::npos);
  for (const char* const plot : {"friction.svg", "friction.png", "spin.svg", "spin.png"}) {
    EXPECT_GT(std::filesystem::file_size(folder_ / "found" / plot), 5000U) << plot;
  }
  // The same throws, in whatever threads.
  ASSERT_EQ(careen({"--throws", "3", "--friction", "0.3,0.1", "--spin", "40,20", "--threads", "3",
                    "--no-plots", "--out", "again"})
                .exitCode,
            0);
  EXPECT_EQ(textOf(folder_ / "again/dice.csv"), csv);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "again/friction.svg"));
}

TEST_F(Dice, badUseIsTold) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"--restitution", "1"},
                                             {"--restitution", "0.5,x"},
                                             {"--friction", "0"},
                                             {"--height", "0.01"},
                                             {"--speed", "nan"},
                                             {"--spin", "-1"},
                                             {"--throws", "0"},
                                             {"--throws", "2.5"},
                                             {"--threads", "0"}}) {
    const Ended ended = careen(arguments);
    EXPECT_EQ(ended.exitCode, 2) << arguments[0];
    EXPECT_NE(ended.err.find(arguments[0] + ": found "), std::string::npos) << ended.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "dice"));
  // A folder that cannot be made is told before the first throw.
  folder_.write("dice", "a file");
  const Ended ended = careen({"--throws", "100"});
  EXPECT_EQ(ended.exitCode, 3);
  EXPECT_NE(ended.err.find("dice: cannot be made: "), std::string::npos) << ended.err;
  EXPECT_EQ(ended.out, "");
}

}  // namespace
}  // namespace careen
