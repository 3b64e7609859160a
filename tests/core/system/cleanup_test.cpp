#include "core/system/cleanup.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace careen {
namespace {

// What cleanups print. It happens in another process, because cleanUpToEnd() keeps the registry locked.
std::string printedBy(const std::function<void(const std::function<void(char)>& print)>& work) {
  std::array<int, 2> ends = {-1, -1};
  EXPECT_EQ(pipe(ends.data()), 0);
  const pid_t process = fork();
  if (process == 0) {
    work([&](char letter) { [[maybe_unused]] const ssize_t written = write(ends[1], &letter, 1); });
    _exit(0);
  }
  close(ends[1]);
  std::string printed;
  for (char letter = 0; read(ends[0], &letter, 1) == 1;) {
    printed += letter;
  }
  close(ends[0]);
  waitpid(process, nullptr, 0);
  return printed;
}

TEST(Cleanup, undoesTheLatestFirstAndForgetsWhatHasEnded) {
  EXPECT_EQ(printedBy([](const auto& print) {
              const Cleanup first([&] { print('a'); });
              auto second = std::make_unique<Cleanup>([&] { print('b'); });
              const Cleanup third([&] { print('c'); });
              second.reset();
              cleanUpToEnd();
              _exit(0);
            }),
            "ca");
}

TEST(Cleanup, goesOnAfterAFailure) {
  EXPECT_EQ(printedBy([](const auto& print) {
              const Cleanup first([&] { print('a'); });
              const Cleanup second([] { throw std::runtime_error("it is gone already"); });
              cleanUpToEnd();
              _exit(0);
            }),
            "a");
}

}  // namespace
}  // namespace careen
