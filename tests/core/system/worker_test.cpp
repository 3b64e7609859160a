#include "core/system/worker.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "support/process.h"

namespace careen {
namespace {

using namespace std::chrono_literals;

struct Pair {
  int a = 0;
  double b = 0;
};

TEST(Worker, hasTheMemoryOfItsParentAndAnswers) {
  const std::vector<double> inherited = {1, 2, 4};
  Worker worker([&inherited](const Channel& channel) {
    for (Pair pair; channel.receive(pair);) {
      pair.b = inherited[static_cast<std::size_t>(pair.a)];
      channel.send(pair);
    }
  });
  for (const int a : {2, 0}) {
    Pair pair{.a = a};
    ASSERT_TRUE(worker.channel().send(pair));
    ASSERT_TRUE(worker.channel().receive(pair));
    EXPECT_EQ(pair.b, inherited[static_cast<std::size_t>(a)]);
  }
  EXPECT_EQ(worker.end().fault, "");
}

// A second worker also holds a copy of the first one's socket: shutting down must reach the first one anyway.
TEST(Worker, endsWhenItsParentShutsDownDespiteOtherWorkers) {
  const auto waits = [](const Channel& channel) {
    for (Pair pair; channel.receive(pair);) {
    }
  };
  Worker first(waits);
  Worker second(waits);
  EXPECT_EQ(first.end().fault, "");
  EXPECT_EQ(second.end().fault, "");
}

TEST(Worker, deathIsToldApart) {
  Worker killed([](const Channel&) { std::raise(SIGKILL); });
  Pair pair;
  EXPECT_FALSE(killed.channel().receive(pair));
  EXPECT_EQ(killed.end().fault, "killed by signal 9 (Killed)");
  Worker left([](const Channel&) { _exit(5); });
  EXPECT_EQ(left.end().fault, "exit code 5");
}

TEST(Worker, tellsWhatItTook) {
  Worker worker([](const Channel&) {
    const auto end = std::chrono::steady_clock::now() + 100ms;
    while (std::chrono::steady_clock::now() < end) {
    }
  });
  EXPECT_GT(worker.end().coreSeconds, 0.01);  // 0.1 on a core of its own
}

TEST(Worker, leavesInterruptionToItsParent) {
  Worker worker([](const Channel& channel) {
    std::raise(SIGTERM);
    std::raise(SIGINT);
    channel.send(Pair{.a = 7});
  });
  Pair pair;
  EXPECT_TRUE(worker.channel().receive(pair));
  EXPECT_EQ(worker.end().fault, "");
}

// The parent is a separate process here, which is killed; its worker would write a file if it outlived it.
TEST(Worker, diesWithItsParent) {
  const TemporaryFolder folder;
  const pid_t parent = fork();
  if (parent == 0) {
    Worker worker([&folder](const Channel& channel) {
      channel.send(Pair{});
      std::this_thread::sleep_for(500ms);
      std::ofstream(folder / "alive") << "still";
      Pair pair;
      channel.receive(pair);
    });
    Pair pair;
    worker.channel().receive(pair);
    std::raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(parent, &status, 0), parent);
  EXPECT_TRUE(WIFSIGNALED(status));
  std::this_thread::sleep_for(1s);
  EXPECT_FALSE(std::filesystem::exists(folder / "alive"));
}

}  // namespace
}  // namespace careen
