#include "core/system/process.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.h"
#include "support/process.h"

namespace careen {
namespace {

std::string messageOf(const std::vector<std::string>& command) {
  try {
    runProgram(command);
  } catch (const MachineError& error) {
    return error.what();
  }
  return "done";
}

TEST(Process, runsToItsEnd) { EXPECT_EQ(messageOf({"true"}), "done"); }

TEST(Process, readsNothing) { EXPECT_EQ(messageOf({"sh", "-c", "! read line"}), "done"); }

TEST(Process, showsTheEndOfTheLogOfAFailure) {
  EXPECT_EQ(messageOf({"sh", "-c", "echo first >&2; echo 'the cause' >&2; exit 3"}),
            "sh failed: first\nthe cause");
  EXPECT_EQ(messageOf({"false"}), "false failed");
  EXPECT_EQ(messageOf({"sh", "-c", "kill -9 $$"}), "sh failed");
}

TEST(Process, runsInTheFolderItIsGiven) {
  const TemporaryFolder folder;
  runProgram({"touch", "here"}, folder.path());
  EXPECT_EQ(folder.files(), std::vector<std::string>{"here"});
}

TEST(Process, saysWhatCannotBeStarted) {
  EXPECT_EQ(messageOf({"no-such-program"}), "cannot start no-such-program: No such file or directory");
}

}  // namespace
}  // namespace careen
