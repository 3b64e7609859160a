#include "core/system/team.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace careen {
namespace {

TEST(Team, doesEachPartOnceByAsManyThreads) {
  for (const int size : {1, 2, 5}) {
    Team team(size);
    std::vector<int> done(7);
    std::array<std::vector<std::thread::id>, 7> by;
    for (int round = 0; round < 3000; ++round) {
      team.run(7, [&](int part) {
        ++done[static_cast<std::size_t>(part)];
        by[static_cast<std::size_t>(part)].push_back(std::this_thread::get_id());
      });
    }
    EXPECT_EQ(done, std::vector<int>(7, 3000));
    std::set<std::thread::id> threads;
    for (const std::vector<std::thread::id>& each : by) {
      threads.insert(each.begin(), each.end());
    }
    EXPECT_LE(threads.size(), static_cast<std::size_t>(size));
  }
}

// A part that waits for all others gets them done, by other threads.
TEST(Team, isHelped) {
  Team team(3);
  for (int round = 0; round < 100; ++round) {
    std::atomic<int> others = 0;
    bool all = true;
    team.run(5, [&](int part) {
      if (part > 0) {
        ++others;
        return;
      }
      const auto begun = std::chrono::steady_clock::now();
      while (others < 4 && std::chrono::steady_clock::now() - begun < std::chrono::seconds(20)) {
        std::this_thread::yield();
      }
      all = others == 4;
    });
    ASSERT_TRUE(all);
  }
}

TEST(Team, sharesRangesThatMakeUpTheWhole) {
  for (const std::size_t count : {0, 1, 255, 256, 257, 1001}) {
    Team team(3);
    std::vector<int> done(count);
    team.share(count, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        ++done[k];
      }
    });
    EXPECT_EQ(done, std::vector<int>(count, 1)) << count;
  }
}

TEST(Team, findsTheLargest) {
  Team team(3);
  for (const std::size_t where : {0, 500, 999}) {
    const auto most = [&](std::size_t first, std::size_t last) {
      return first <= where && where < last ? 2.5 : 1.0;
    };
    EXPECT_EQ(team.largest(1000, most), 2.5);
  }
  EXPECT_EQ(team.largest(0, [](std::size_t, std::size_t) { return -1.0; }), 0);
}

TEST(Team, passesAnErrorOnAndGoesOn) {
  Team team(3);
  for (int bad = 0; bad < 6; ++bad) {
    try {
      team.run(6, [&](int part) {
        if (part == bad) {
          throw std::runtime_error("part " + std::to_string(part));
        }
      });
      ADD_FAILURE();
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), "part " + std::to_string(bad));
    }
  }
  std::atomic<int> done = 0;
  team.run(6, [&](int) { ++done; });
  EXPECT_EQ(done, 6);
}

// Threads that have fallen asleep wake again, and those that were never needed need not end.
TEST(Team, worksAfterAPause) {
  const Team idle(4);
  Team team(2);
  std::atomic<int> done = 0;
  for (int round = 0; round < 3; ++round) {
    team.run(2, [&](int) { ++done; });
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(done, 6);
}

}  // namespace
}  // namespace careen
