#include "core/system/rounds.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "core/system/team.h"

namespace careen {
namespace {

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

// Cells that belong to two parts each, or to one. What a part makes of its cells depends on the order in
// which their parts did.
struct Cells {
  std::vector<std::vector<std::size_t>> of;  // by part
  std::vector<std::uint64_t> values;
  std::vector<int> roundsLeft;  // by part, in which it does anything

  Cells(std::size_t parts, const Pairs& sharing) : of(parts), values(parts + sharing.size(), 1) {
    for (std::size_t k = 0; k < parts; ++k) {
      of[k].push_back(k);
      roundsLeft.push_back(static_cast<int>(3 * k % 7));
    }
    for (std::size_t k = 0; k < sharing.size(); ++k) {
      of[sharing[k].first].push_back(parts + k);
      of[sharing[k].second].push_back(parts + k);
    }
  }
  std::int64_t work(std::size_t part) {
    if (roundsLeft[part] == 0) {
      return 0;
    }
    --roundsLeft[part];
    std::uint64_t mixed = part;
    for (const std::size_t cell : of[part]) {
      mixed = (mixed ^ values[cell]) * 0x9e3779b97f4a7c15U;
    }
    for (const std::size_t cell : of[part]) {
      values[cell] += mixed;
    }
    return static_cast<std::int64_t>(part) + 1;
  }
};

void waitUntil(const std::atomic<bool>& happened) {
  const auto begun = std::chrono::steady_clock::now();
  while (!happened && std::chrono::steady_clock::now() - begun < std::chrono::seconds(20)) {
    std::this_thread::yield();
  }
}

TEST(Rounds, doWhatOneThreadDoesInOrder) {
  std::mt19937 random(1);
  Rounds rounds;
  for (const int size : {1, 2, 3, 5}) {
    Team team(size);
    for (int k = 0; k < 300; ++k) {
      const std::size_t parts = 1 + random() % 12;
      Pairs sharing;
      rounds.begin(parts);
      for (std::size_t part = 0; part < parts; ++part) {
        rounds.setPlace(part, 0x1p-32 * static_cast<double>(random()));
        for (std::size_t other = 0; other < part; ++other) {
          if (random() % 3 == 0) {
            sharing.emplace_back(part, other);
            rounds.share(part, other);
          }
        }
      }
      Cells expected(parts, sharing);
      const int most = static_cast<int>(random() % 9);
      std::int64_t all = 0;
      std::int64_t did = 1;
      for (int round = 0; round < most && did > 0; ++round) {
        did = 0;
        for (std::size_t part = 0; part < parts; ++part) {
          did += expected.work(part);
        }
        all += did;
      }
      Cells cells(parts, sharing);
      EXPECT_EQ(rounds.run(team, most, [&](std::size_t part) { return cells.work(part); }), all);
      ASSERT_EQ(cells.values, expected.values) << size << " threads, " << k;
      ASSERT_EQ(cells.roundsLeft, expected.roundsLeft);
    }
  }
}

// The second part is not done with the first round before the first part has begun the second one.
TEST(Rounds, doNotWaitForPartsThatShareNothing) {
  Team team(2);
  Rounds rounds;
  rounds.begin(2);
  rounds.setPlace(1, 0.5);
  std::atomic<int> first = 0;
  std::atomic<bool> begun = false;
  rounds.run(team, 2, [&](std::size_t part) {
    if (part == 0) {
      begun = ++first == 2;
    } else {
      waitUntil(begun);
      EXPECT_TRUE(begun);
    }
    return 1;
  });
}

// The first part waits for the others, which are the same thread's: another one does them.
TEST(Rounds, areHelped) {
  Team team(2);
  Rounds rounds;
  rounds.begin(4);
  for (int run = 0; run < 100; ++run) {
    std::atomic<int> others = 0;
    std::atomic<bool> all = false;
    rounds.run(team, 1, [&](std::size_t part) {
      if (part == 0) {
        waitUntil(all);
        EXPECT_TRUE(all);
      } else {
        all = ++others == 3;
      }
      return 0;
    });
  }
}

}  // namespace
}  // namespace careen
