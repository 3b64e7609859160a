#include "physics/pile/pairs.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "support/physics_worlds.h"
#include "support/pile_scenes.h"

namespace careen {
namespace {

using Found = std::set<std::pair<int, int>>;

// Bodies that fly about without touching: every pair whose boxes about the axes meet must be listed, whatever
// boxes were kept, refitted or built anew before; and the list stays in the order of its keys, walls last.
TEST(PilePairs, listsEveryPairThatCanTouchThroughoutAFlight) {
  const double frame = 1.0 / 60;
  World world = test::pouring(150, 0, 0, 1, 5);
  test::Pourer pourer(7);
  std::vector<PileBody> bodies;
  for (const Wall& wall : world.walls) {
    bodies.push_back(pileBody(wall));
  }
  const int walls = static_cast<int>(bodies.size());
  for (Body& body : world.bodies) {
    body.initial.velocity = pourer.vector(-6, 6);
    bodies.push_back(pileBody(body, body.initial));
  }
  PilePairs pairs;
  const auto bounds = [](const PileBody& body) {
    const Vec3 reach = body.axes.cwiseAbs() * body.halfExtents;
    return std::pair<Vec3, Vec3>(body.position - reach, body.position + reach);
  };
  std::size_t touching = 0;
  std::size_t most = 0;
  for (int k = 0; k < 60; ++k) {
    pairs.update(bodies, Vec3::Zero(), frame, 2 * frame);
    for (PileBody& body : bodies) {
      body.position += frame * body.velocity;
    }
    Found found;
    for (std::size_t i = 0; i < pairs.pairs().size(); ++i) {
      const PilePair& pair = pairs.pairs()[i];
      ASSERT_TRUE(i == 0 || pairs.pairs()[i - 1].key < pair.key);
      ASSERT_TRUE(i == 0 || pairs.pairs()[i - 1].a < pair.a || pairs.pairs()[i - 1].b >= walls ||
                  pair.b < walls);
      found.insert({pair.a, pair.b});
    }
    most = std::max(most, found.size());
    for (int i = walls; i < walls + 150; ++i) {
      const auto [low, high] = bounds(bodies[static_cast<std::size_t>(i)]);
      for (int j = i + 1; j < walls + 150; ++j) {
        const auto [otherLow, otherHigh] = bounds(bodies[static_cast<std::size_t>(j)]);
        if ((low.array() <= otherHigh.array()).all() && (otherLow.array() <= high.array()).all()) {
          ++touching;
          ASSERT_TRUE(found.contains({i, j})) << k << ": " << i << ", " << j;
        }
      }
      for (int w = 0; w < walls; ++w) {
        const Wall& wall = world.walls[static_cast<std::size_t>(w)];
        const Vec3 lowest = (wall.normal.array() > 0).select(low, high);
        if (wall.normal.dot(lowest) < wall.offset) {
          ASSERT_TRUE(found.contains({i, w}));
        }
      }
    }
  }
  EXPECT_GT(touching, 1000U);
  EXPECT_LT(most, 150U * 149U / 4U);
}

// Three boxes in one place, of which the first two pass through each other.
TEST(PilePairs, leavesOutWhatPassesThroughEachOther) {
  const World world = test::pouring(3, 0, 0, 1, 5);
  std::vector<PileBody> bodies;
  for (const Body& body : world.bodies) {
    bodies.push_back(pileBody(body, {.pose = {}}));
  }
  PilePairs pairs(std::make_shared<Team>(1), [](int a, int b) { return a + b != 1; });
  pairs.update(bodies, Vec3::Zero(), 0.01, 0.02);
  Found found;
  for (const PilePair& pair : pairs.pairs()) {
    found.emplace(pair.a, pair.b);
  }
  EXPECT_EQ(found, (Found{{0, 2}, {1, 2}}));
}

// A table, a crate and a wall: each box of the one with each of the other, in the order of bodies and boxes.
TEST(PilePairs, areOfAllBoxesOfTwoBodies) {
  World world;
  world.walls = {floorAt(0)};
  Body table = makeBox({.position = Vec3(0, 0, 0.2), .name = "table"});
  setParts(table, {{.halfExtents = Vec3(0.3, 0.3, 0.05), .center = Vec3(0, 0, 0.2)},
                   {.halfExtents = Vec3(0.05, 0.05, 0.2)}});
  world.bodies = {table, makeBox({.position = Vec3(0.2, 0, 0.6), .name = "crate"}), table};
  world.bodies[2].initial.pose.position.x() = 0.5;
  std::vector<PileBody> bodies{pileBody(world.walls[0])};
  for (const Body& body : world.bodies) {
    bodies.push_back(pileBody(body, body.initial));
  }
  PilePairs pairs;
  pairs.update(bodies, Vec3::Zero(), 0.01, 0.1);
  using FoundBoxes = std::array<int, 4>;
  std::vector<FoundBoxes> found;
  for (const PilePair& pair : pairs.pairs()) {
    found.push_back({pair.a, pair.boxA, pair.b, pair.boxB});
  }
  const std::vector<FoundBoxes> expected{{1, 0, 2, 0}, {1, 1, 2, 0}, {1, 0, 3, 0}, {1, 0, 3, 1},
                                         {1, 1, 3, 0}, {1, 1, 3, 1}, {1, 0, 0, 0}, {1, 1, 0, 0},
                                         {2, 0, 3, 0}, {2, 0, 3, 1}, {3, 0, 0, 0}, {3, 1, 0, 0}};
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace careen
