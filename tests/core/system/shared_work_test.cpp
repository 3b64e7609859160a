#include "core/system/shared_work.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <set>
#include <string>

#include "core/error.h"
#include "support/process.h"

namespace careen {
namespace {

TEST(SharedWork, isDoneOnceEachInSeveralProcesses) {
  const TemporaryFolder folder;
  std::multiset<std::int64_t> done;
  shareWork(
      40, 3,
      [&](std::int64_t index) {
        folder.write(std::to_string(index), std::to_string(getpid()));
        usleep(1000);
      },
      [&](std::int64_t index) { done.insert(index); });
  EXPECT_EQ(done.size(), 40U);
  std::set<std::string> processes;
  for (std::int64_t index = 0; index < 40; ++index) {
    EXPECT_EQ(done.count(index), 1U);
    processes.insert(textOf(folder / std::to_string(index)));
  }
  EXPECT_EQ(processes.size(), 3U);
  EXPECT_FALSE(processes.contains(std::to_string(getpid())));
}

TEST(SharedWork, errorsKeepTheirMessageAndExitCode) {
  try {
    shareWork(10, 2, [](std::int64_t index) {
      if (index == 3) {
        throw NumericalError("run 3 broke");
      }
    });
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "run 3 broke");
    EXPECT_EQ(error.code(), ExitCode::kNumbersFailed);
  }
}

TEST(SharedWork, aDeadProcessIsTold) {
  try {
    shareWork(10, 2, [](std::int64_t index) {
      if (index == 3) {
        raise(SIGKILL);
      }
    });
    FAIL();
  } catch (const MachineError& error) {
    EXPECT_NE(std::string(error.what()).find("signal 9"), std::string::npos) << error.what();
  }
}

TEST(SharedWork, stopsAfterWhatIsInHand) {
  std::stop_source stop;
  int done = 0;
  EXPECT_THROW(shareWork(
                   1000, 2, [](std::int64_t) { usleep(100); },
                   [&](std::int64_t) {
                     if (++done == 5) {
                       stop.request_stop();
                     }
                   },
                   stop.get_token()),
               Interrupted);
  EXPECT_GE(done, 5);
  EXPECT_LE(done, 7);
}

TEST(SharedWork, nothingToDoIsDone) {
  shareWork(0, 2, [](std::int64_t) { FAIL(); });
}

}  // namespace
}  // namespace careen
