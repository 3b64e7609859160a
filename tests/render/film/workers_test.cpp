#include "render/film/workers.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <set>
#include <string>

#include "core/error.h"
#include "support/process.h"

namespace careen {
namespace {

using namespace std::chrono_literals;

// Draws nothing: a frame's time is twice its number.
FrameWorkshop doubling() {
  return {.renderer = "nobody", .work = [](std::int64_t, std::int64_t frame) {
            return FrameFigures{.frame = frame, .time = 2 * static_cast<double>(frame)};
          }};
}

std::string errorOf(FilmWorkers& workers) {
  try {
    for (int tries = 0; tries < 1000; ++tries) {
      workers.wait(-1, 10ms);
    }
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(FilmWorkers, everyFrameGivenComesBackOnce) {
  FilmWorkers workers(3, doubling);
  EXPECT_EQ(workers.renderer(), "nobody");
  std::set<std::int64_t> back;
  for (std::int64_t given = 0; back.size() < 100;) {
    while (given < 100 && workers.hasIdle()) {
      workers.give(given, given + 1000);
      ++given;
    }
    for (const FilmWorkers::Done& done : workers.wait(-1, 100ms)) {
      EXPECT_EQ(done.figures.frame, done.index + 1000);
      EXPECT_EQ(done.figures.time, 2 * static_cast<double>(done.index + 1000));
      EXPECT_TRUE(back.insert(done.index).second) << done.index;
    }
  }
  EXPECT_GT(workers.finish(), 0);
}

TEST(FilmWorkers, workersSideBySide) {
  FilmWorkers workers(2, [] {
    return FrameWorkshop{.renderer = "", .work = [](std::int64_t, std::int64_t frame) {
                           usleep(300'000);
                           return FrameFigures{.frame = frame, .time = static_cast<double>(getpid())};
                         }};
  });
  workers.give(0, 0);
  workers.give(1, 1);
  EXPECT_FALSE(workers.hasIdle());
  std::set<double> processes;
  for (int tries = 0; tries < 100 && processes.size() < 2; ++tries) {
    for (const FilmWorkers::Done& done : workers.wait(-1, 100ms)) {
      processes.insert(done.figures.time);
    }
  }
  EXPECT_EQ(processes.size(), 2U);
}

TEST(FilmWorkers, whatCannotBeMadeReadyIsThrownAsItIs) {
  EXPECT_THROW(FilmWorkers(2, []() -> FrameWorkshop { throw InputError("too large"); }), InputError);
  EXPECT_THROW(FilmWorkers(2, []() -> FrameWorkshop { throw MachineError("no GL"); }), MachineError);
  EXPECT_THROW(FilmWorkers(2, []() -> FrameWorkshop { throw std::bad_alloc(); }), MachineError);
}

// The renderer's name came in the same buffer, and is longer.
TEST(FilmWorkers, failureOfAFrameIsThrownAsItIs) {
  FilmWorkers workers(1, [] {
    return FrameWorkshop{
        .renderer = "Mesa, llvmpipe, by OSMesa",
        .work = [](std::int64_t, std::int64_t) -> FrameFigures { throw MachineError("disk full"); }};
  });
  workers.give(0, 0);
  EXPECT_EQ(errorOf(workers), "disk full");
}

TEST(FilmWorkers, deathIsToldWithTheFrame) {
  FilmWorkers workers(2, [] {
    return FrameWorkshop{.renderer = "", .work = [](std::int64_t, std::int64_t frame) {
                           if (frame == 12) {
                             std::raise(SIGSEGV);
                           }
                           return FrameFigures{.frame = frame};
                         }};
  });
  workers.give(0, 11);
  workers.give(1, 12);
  const std::string said = errorOf(workers);
  // Sanitizers catch the signal and exit in their own way.
  EXPECT_TRUE(said.starts_with("frame 12: a process that draws frames died: ")) << said;
}

TEST(FilmWorkers, deathBeforeAnyFrameIsTold) {
  EXPECT_THROW(FilmWorkers(2, []() -> FrameWorkshop { _exit(1); }), MachineError);
}

}  // namespace
}  // namespace careen
