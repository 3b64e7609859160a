#include "physics/pile/block_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "core/system/team.h"
#include "support/pile_scenes.h"

namespace careen {
namespace {

// The last of them is a wall.
std::vector<SolverBody> inARow(int count) {
  std::vector<SolverBody> bodies(at(count) + 1);
  for (int k = 0; k < count; ++k) {
    bodies[at(k)] = {.inverseMass = 1, .place = Vec3(k, 0, 0)};
  }
  return bodies;
}

std::vector<int> blocksOf(const BlockGroups::Group& group) {
  return {group.blocks.begin(), group.blocks.begin() + group.used};
}

// Links of a chain of five: 0–1 and 2–3 share no body, nor do 1–2 and 3–4.
TEST(BlockGroups, takeLinksOfAChainInTurn) {
  const std::vector<SolverBody> bodies = inARow(5);
  std::vector<RowBlock> blocks(4);
  for (int k = 0; k < 4; ++k) {
    blocks[at(k)] = {.a = k, .b = k + 1, .first = 2 * k, .count = 2};
  }
  BlockGroups groups(std::make_shared<Team>(1));
  groups.find(blocks, bodies);
  ASSERT_EQ(groups.groups().size(), 2U);
  EXPECT_EQ(blocksOf(groups.groups()[0]), (std::vector{0, 2}));
  EXPECT_EQ(blocksOf(groups.groups()[1]), (std::vector{1, 3}));
  EXPECT_EQ(groups.groups()[0].count, 2);
  EXPECT_EQ(groups.groups()[1].first, 2);
  EXPECT_EQ(groups.rowCount(), 4);
  EXPECT_EQ(groups.placeOf(1), kLanes);       // the first lane of the second group
  EXPECT_EQ(groups.placeOf(2), 1);            // the second of the first
  EXPECT_EQ(groups.bodyCount(), 5U + 1 + 1);  // and the wall, and nobody of the one part
}

// Five on a floor share a wall, which does not move: four of them are a group. Blocks of another number of
// rows are none of it.
TEST(BlockGroups, shareWallsAndHeldBodies) {
  std::vector<SolverBody> bodies = inARow(7);
  bodies[6] = {};  // held
  std::vector<RowBlock> blocks(6);
  for (int k = 0; k < 6; ++k) {
    blocks[at(k)] = {.a = k, .b = k % 2 == 0 ? 6 : 7, .first = 4 * k, .count = k == 1 ? 3 : 4};
  }
  std::swap(blocks[2].a, blocks[2].b);
  BlockGroups groups(std::make_shared<Team>(1));
  groups.find(blocks, bodies);
  ASSERT_EQ(groups.groups().size(), 3U);
  EXPECT_EQ(blocksOf(groups.groups()[0]), (std::vector{0, 2, 3, 4}));
  EXPECT_EQ(blocksOf(groups.groups()[1]), (std::vector{1}));
  EXPECT_EQ(blocksOf(groups.groups()[2]), (std::vector{5}));
  const int nobody = 8;
  EXPECT_EQ(groups.groups()[0].a, (LaneBodies{0, nobody, 3, 4}));
  EXPECT_EQ(groups.groups()[0].b, (LaneBodies{nobody, 2, nobody, nobody}));
  EXPECT_EQ(groups.groups()[1].a, (LaneBodies{1, nobody, nobody, nobody}));
}

// Pairs anywhere in a long row of bodies, most of them neighbours, in many parts.
class ManyBlocks : public testing::Test {
 protected:
  static constexpr int kBodies = 1500;
  ManyBlocks() : bodies(inARow(kBodies)), groups(std::make_shared<Team>(2)) {
    test::Pourer pourer(1);
    int first = 0;
    for (int k = 0; k < 5000; ++k) {
      const int a = static_cast<int>(pourer.between(0, kBodies - 4));
      const int far = k % 500 == 0 ? (a + kBodies / 2) % kBodies : a + 1 + k % 3;
      const int rows = 1 + k % 4;
      blocks.push_back({.a = a, .b = k % 7 == 0 ? kBodies : far, .first = first, .count = rows});
      first += rows;
    }
    for (int k = 0; k < kBodies; k += 20) {
      bodies[at(k)] = {};
    }
    groups.find(blocks, bodies);
  }
  /// Bodies of the blocks in these groups that move.
  std::vector<int> moversOf(std::size_t first, std::size_t last) const {
    std::vector<int> movers;
    for (std::size_t k = first; k < last; ++k) {
      for (const int block : blocksOf(groups.groups()[k])) {
        for (const int body : {blocks[at(block)].a, blocks[at(block)].b}) {
          if (bodies[at(body)].moves()) {
            movers.push_back(body);
          }
        }
      }
    }
    return movers;
  }

  std::vector<SolverBody> bodies;
  std::vector<RowBlock> blocks;
  BlockGroups groups;
};

TEST_F(ManyBlocks, ofAGroupShareNoBodyThatMoves) {
  std::size_t full = 0;
  for (std::size_t k = 0; k < groups.groups().size(); ++k) {
    const std::vector<int> movers = moversOf(k, k + 1);
    EXPECT_EQ(std::set(movers.begin(), movers.end()).size(), movers.size()) << k;
    full += groups.groups()[k].used == kLanes ? 1 : 0;
  }
  EXPECT_GT(full, 1000U) << full;
}

TEST_F(ManyBlocks, areEachInOnePlaceAndSoAreTheirRows) {
  std::set<int> places;
  int rows = 0;
  for (std::size_t k = 0; k < groups.groups().size(); ++k) {
    const BlockGroups::Group& group = groups.groups()[k];
    EXPECT_EQ(group.first, rows);
    rows += group.count;
    for (int lane = 0; lane < group.used; ++lane) {
      const int block = group.blocks[at(lane)];
      EXPECT_EQ(groups.placeOf(block), static_cast<int>(k) * kLanes + lane);
      EXPECT_EQ(group.counts[at(lane)], blocks[at(block)].count);
      EXPECT_EQ(group.count, blocks[at(block)].count);  // all of one number
      places.insert(groups.placeOf(block));
    }
  }
  EXPECT_EQ(places.size(), blocks.size());
  EXPECT_EQ(groups.rowCount(), rows);
}

// Slabs, then what is between every second pair, then between the others: of each kind, none shares a body
// with another. Eight slabs are the most.
TEST_F(ManyBlocks, areDividedSoThatPartsOfAKindShareNoBody) {
  ASSERT_EQ(groups.partCount(), 16U);
  std::vector<std::vector<int>> movers(16);
  groups.forParts(
      [&](std::size_t part, std::size_t first, std::size_t last) { movers[part] = moversOf(first, last); });
  const auto expectApart = [&](std::size_t first, std::size_t last) {
    std::set<int> seen;
    for (std::size_t part = first; part < last; ++part) {
      EXPECT_FALSE(movers[part].empty()) << part;
      const std::set<int> own(movers[part].begin(), movers[part].end());
      for (const int body : own) {
        EXPECT_TRUE(seen.insert(body).second) << body << " in part " << part;
      }
    }
  };
  expectApart(0, 8);
  expectApart(8, 12);
  expectApart(12, 15);
  EXPECT_FALSE(movers[15].empty());  // who are far from each other
}

// In each round, of two parts that share a body, the later one is done after the earlier one.
TEST_F(ManyBlocks, waitForThoseWithWhomTheyShareABody) {
  const std::size_t parts = groups.partCount();
  std::vector<std::set<int>> movers(parts);
  groups.forParts([&](std::size_t part, std::size_t first, std::size_t last) {
    const std::vector<int> all = moversOf(first, last);
    movers[part] = std::set(all.begin(), all.end());
  });
  const auto share = [&](std::size_t k, std::size_t other) {
    return std::any_of(movers[k].begin(), movers[k].end(),
                       [&](int body) { return movers[other].contains(body); });
  };
  std::vector<std::atomic<int>> rounds(parts);
  std::atomic<int> early = 0;
  groups.order();
  const std::int64_t done = groups.sweep(50, [&](std::size_t part, std::size_t, std::size_t) {
    for (std::size_t other = 0; other < parts; ++other) {
      const int expected = rounds[part] + (other < part ? 1 : 0);
      early += other != part && share(part, other) && rounds[other] != expected ? 1 : 0;
    }
    ++rounds[part];
    return 1;
  });
  EXPECT_EQ(done, static_cast<std::int64_t>(50 * parts));
  EXPECT_EQ(early, 0);
}

}  // namespace
}  // namespace careen
