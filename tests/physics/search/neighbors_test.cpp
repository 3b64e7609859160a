#include "physics/search/neighbors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/tumbling_box.h"

namespace careen {
namespace {

using test::Dice;

struct Ball {
  Vec3 position;
  Vec3 velocity;
  Vec3 acceleration;
  double radius = 0;
  Vec3 at(double t) const { return position + velocity * t + 0.5 * t * t * acceleration; }
};

std::vector<Ball> balls(int count, double room, std::uint64_t seed) {
  Dice dice(seed);
  std::vector<Ball> result;
  result.reserve(static_cast<std::size_t>(count) + 1);
  for (int k = 0; k < count; ++k) {
    result.push_back({.position = dice.vector(room),
                      .velocity = dice.vector(1.5),
                      .acceleration = Vec3(0, 0, k % 2 == 0 ? -1 : 0),
                      .radius = dice.between(0.25, 0.3)});
  }
  return result;
}

Neighbors gridOf(const std::vector<Ball>& all) {
  std::vector<double> radii;
  radii.reserve(all.size());
  for (const Ball& ball : all) {
    radii.push_back(ball.radius);
  }
  return Neighbors(radii);
}

// 60 balls fly through each other for 2 s, filed anew at their crossings alone: at each of 2000 moments
// everyone who touches is a candidate.
TEST(Neighbors, whoTouchesIsAlwaysACandidate) {
  const std::vector<Ball> all = balls(60, 2, 61);
  Neighbors grid = gridOf(all);
  std::vector<Neighbors::Crossing> next;
  for (int k = 0; k < 60; ++k) {
    const Ball& ball = all.at(static_cast<std::size_t>(k));
    grid.insert(k, ball.position, ball.radius);
    next.push_back(grid.nextCrossing(ball.position, ball.velocity, ball.acceleration, grid.cell(k), 0));
  }
  int crossings = 0;
  int touches = 0;
  std::size_t listed = 0;
  std::vector<Neighbors::Key> candidates;
  for (int step = 0; step < 2000; ++step) {
    const double t = 2.0 * step / 2000;
    for (std::size_t k = 0; k < all.size(); ++k) {
      while (next[k].time <= t) {
        const auto key = static_cast<int>(k);
        grid.move(key, next[k].cell);
        next[k] = grid.nextCrossing(all[k].position, all[k].velocity, all[k].acceleration, grid.cell(key),
                                    next[k].time);
        ++crossings;
      }
    }
    for (std::size_t k = 0; k < all.size(); ++k) {
      grid.findCandidates(static_cast<int>(k), candidates);
      listed += candidates.size();
      ASSERT_TRUE(std::is_sorted(candidates.begin(), candidates.end()));
      for (std::size_t other = 0; other < all.size(); ++other) {
        const double reach = all[k].radius + all[other].radius;
        if (other != k && (all[k].at(t) - all[other].at(t)).norm() <= reach) {
          ++touches;
          ASSERT_TRUE(
              std::binary_search(candidates.begin(), candidates.end(), static_cast<Neighbors::Key>(other)));
        }
      }
    }
  }
  EXPECT_GT(crossings, 200);
  EXPECT_GT(touches, 1000);
  // Far fewer than all: measured 3.2 of 59 on average, as they fly apart.
  EXPECT_LT(static_cast<double>(listed) / (2000 * 60), 10);
}

// Of a cubic, against 4000 places on its way: never is it further outside than 1/16 of an edge before it is
// filed anew, and then by more than 1/64.
TEST(Neighbors, cubicsCrossWhereTheyLeave) {
  Dice dice(64);
  const Neighbors grid = gridOf(balls(60, 2, 61));
  const double edge = grid.cellEdge();
  int crossings = 0;
  for (int k = 0; k < 100; ++k) {
    const Flight flight{.position = dice.vector(1),
                        .velocity = dice.vector(2),
                        .acceleration = dice.vector(4),
                        .jerk = dice.vector(8)};
    const auto outside = [&](double time, const Cell& cell) {
      double most = 0;
      for (int i = 0; i < 3; ++i) {
        const double inside =
            flight.positionAt(time)(i) / edge - static_cast<double>(cell[static_cast<std::size_t>(i)]);
        most = std::max({most, -inside, inside - 1});
      }
      return most;
    };
    Cell cell = grid.cellOf(flight.position);
    double time = 0;
    while (time < 2) {
      const Neighbors::Crossing next = grid.nextCrossing(flight, 2, cell, time);
      for (int sample = 0; sample <= 100; ++sample) {
        const double t = time + (std::min(next.time, 2.0) - time) * sample / 100;
        EXPECT_LT(outside(t, cell), 1.0 / 16 + 1e-12);
      }
      if (next.time < 2) {
        EXPECT_GT(outside(next.time, cell), 1.0 / 64);
        ++crossings;
      }
      cell = next.cell;
      time = next.time;
    }
  }
  EXPECT_GT(crossings, 300);
}

TEST(Neighbors, thinkNothingOfTheOrderOfFiling) {
  const std::vector<Ball> all = balls(100, 1.5, 62);
  Neighbors forwards = gridOf(all);
  Neighbors backwards = gridOf(all);
  for (int k = 0; k < 100; ++k) {
    forwards.insert(k, all.at(static_cast<std::size_t>(k)).position,
                    all.at(static_cast<std::size_t>(k)).radius);
    const auto other = static_cast<std::size_t>(99 - k);
    backwards.insert(99 - k, all.at(other).position, all.at(other).radius);
  }
  std::vector<Neighbors::Key> a;
  std::vector<Neighbors::Key> b;
  for (int k = 0; k < 100; ++k) {
    forwards.findCandidates(k, a);
    backwards.findCandidates(k, b);
    ASSERT_EQ(a, b);
  }
}

// Per body as many candidates among 8000 as among 1000 in the same density.
TEST(Neighbors, costTheSameHoweverManyThereAre) {
  const auto candidatesPerBody = [](int count, double room) {
    const std::vector<Ball> all = balls(count, room, 63);
    Neighbors grid = gridOf(all);
    for (int k = 0; k < count; ++k) {
      grid.insert(k, all.at(static_cast<std::size_t>(k)).position,
                  all.at(static_cast<std::size_t>(k)).radius);
    }
    std::size_t sum = 0;
    std::vector<Neighbors::Key> candidates;
    for (int k = 0; k < count; ++k) {
      grid.findCandidates(k, candidates);
      sum += candidates.size();
    }
    return static_cast<double>(sum) / count;
  };
  const double few = candidatesPerBody(1000, 5);
  const double many = candidatesPerBody(8000, 10);
  // Measured 7.3 and 8.0: fewer of the many stand at the border.
  EXPECT_LT(many, 1.3 * few);
}

TEST(Neighbors, aFloorIsEveryonesCandidateAndDoesNotWidenTheCells) {
  std::vector<Ball> all = balls(50, 5, 64);
  Neighbors small = gridOf(all);
  all.push_back(
      {.position = Vec3::Zero(), .velocity = Vec3::Zero(), .acceleration = Vec3::Zero(), .radius = 20});
  Neighbors grid = gridOf(all);
  EXPECT_EQ(grid.cellEdge(), small.cellEdge());
  for (int k = 0; k < 51; ++k) {
    grid.insert(k, all.at(static_cast<std::size_t>(k)).position, all.at(static_cast<std::size_t>(k)).radius);
  }
  EXPECT_FALSE(grid.isFiled(50));
  std::vector<Neighbors::Key> candidates;
  for (int k = 0; k < 50; ++k) {
    grid.findCandidates(k, candidates);
    EXPECT_EQ(candidates.back(), 50);
  }
  grid.findCandidates(50, candidates);
  EXPECT_EQ(candidates.size(), 50U);
  grid.erase(50);
  grid.findCandidates(0, candidates);
  EXPECT_FALSE(std::binary_search(candidates.begin(), candidates.end(), 50));
}

TEST(Neighbors, fewHaveNoGridAndAreAllCandidates) {
  const std::vector<double> radii(Neighbors::kFew, 0.5);
  Neighbors few(radii);
  for (int k = 0; k < static_cast<int>(Neighbors::kFew); ++k) {
    few.insert(k, Vec3(1000 * k, 0, 0), 0.5);
    EXPECT_FALSE(few.isFiled(k));
  }
  std::vector<Neighbors::Key> candidates;
  few.findCandidates(3, candidates);
  EXPECT_EQ(candidates, (std::vector<Neighbors::Key>{0, 1, 2, 4, 5, 6, 7}));
}

// Of a floor and 50 balls, and of few: nobody else, nobody twice, and nobody after the first.
TEST(Neighbors, asksEachCandidateOnce) {
  std::vector<Ball> all = balls(50, 2, 65);
  all.push_back(
      {.position = Vec3::Zero(), .velocity = Vec3::Zero(), .acceleration = Vec3::Zero(), .radius = 20});
  for (const std::size_t count : {std::size_t{5}, all.size()}) {
    const std::vector<Ball> some(all.end() - static_cast<std::ptrdiff_t>(count), all.end());
    Neighbors grid = gridOf(some);
    for (std::size_t k = 0; k < count; ++k) {
      grid.insert(static_cast<int>(k), some[k].position, some[k].radius);
    }
    for (int k = 0; k < static_cast<int>(count); ++k) {
      std::vector<Neighbors::Key> asked;
      EXPECT_FALSE(grid.anyCandidate(k, [&](int key) {
        asked.push_back(key);
        return false;
      }));
      std::sort(asked.begin(), asked.end());
      std::vector<Neighbors::Key> candidates;
      grid.findCandidates(k, candidates);
      EXPECT_EQ(asked, candidates);
      int calls = 0;
      EXPECT_TRUE(grid.anyCandidate(k, [&](int) { return ++calls == 1; }));
      EXPECT_EQ(calls, 1);
    }
  }
}

// Cells of edge 1 (diameter 7/8). From 0.5 at 1 m/s the centre is 1/16 past the border at 0.5625 s; thrown up
// at 4 m/s under 8 m/s² it comes to z = 1.5 only and leaves its cell 0 at 1 + 1/16, where 4t − 4t² = 0.5625:
// t = 0.1691.
TEST(Neighbors, crossingsAreTheClosedForm) {
  const std::vector<double> radii(Neighbors::kFew + 1, 0.4375);
  const Neighbors grid(radii);
  ASSERT_EQ(grid.cellEdge(), 1);
  const Vec3 middle(0.5, 0.5, 0.5);
  const auto straight = grid.nextCrossing(middle, Vec3(1, 0, 0), Vec3::Zero(), {0, 0, 0}, 0);
  EXPECT_EQ(straight.time, 0.5625);
  EXPECT_EQ(straight.cell, (Cell{1, 0, 0}));
  const auto up = grid.nextCrossing(middle, Vec3(0, 0, 4), Vec3(0, 0, -8), {0, 0, 0}, 0);
  EXPECT_NEAR(up.time, 0.5 * (1 - std::sqrt(1 - 0.5625)), 1e-15);
  EXPECT_EQ(up.cell, (Cell{0, 0, 1}));
  // And back down, 1/16 below the border it came up through: 4t − 4t² = 0.4375.
  const auto down = grid.nextCrossing(middle, Vec3(0, 0, 4), Vec3(0, 0, -8), up.cell, up.time);
  EXPECT_NEAR(down.time, 0.5 * (1 + std::sqrt(1 - 0.4375)), 1e-15);
  EXPECT_EQ(down.cell, (Cell{0, 0, 0}));
  const auto never = grid.nextCrossing(middle, Vec3::Zero(), Vec3::Zero(), {0, 0, 0}, 5);
  EXPECT_GT(never.time, 1e60);
}

// 100 steps of degree 5 that wind through some ten cells: followed from crossing to crossing, a centre is
// never more than 1/16 of an edge outside the cell that it is filed in, and no crossing comes before it is
// 3/64 outside.
TEST(Neighbors, crossingsOfAContactStepKeepItsCellTrue) {
  const std::vector<double> radii(Neighbors::kFew + 1, 0.4375);
  const Neighbors grid(radii);
  Dice dice(7);
  int crossings = 0;
  for (int trial = 0; trial < 100; ++trial) {
    ContactStep step{.duration = dice.between(0.5, 2)};
    for (Vec3& each : step.position) {
      each = dice.vector(3);
    }
    step.worldFromBody.fill(Vec4::Zero());
    step.worldFromBody[0] = Vec4(0, 0, 0, 1);
    const double fastest = boundsOf(step).speed;
    Cell cell = grid.cellOf(step.position[0]);
    Neighbors::Crossing next = grid.nextCrossing(step, fastest, cell, 0);
    const auto outside = [&](double time) {
      const Vec3 at = positionAt(step, time);
      double most = 0;
      for (int i = 0; i < 3; ++i) {
        const double inside = at(i) - static_cast<double>(cell[static_cast<std::size_t>(i)]);
        most = std::max({most, -inside, inside - 1});
      }
      return most;
    };
    for (int k = 0; k <= 4000; ++k) {
      const double time = step.duration * k / 4000;
      while (next.time <= time) {
        EXPECT_GT(outside(next.time), 3.0 / 64 - 1e-12);
        EXPECT_NE(next.cell, cell);
        cell = next.cell;
        next = grid.nextCrossing(step, fastest, cell, next.time);
        ++crossings;
      }
      ASSERT_LT(outside(time), 1.0 / 16 + 1e-12) << trial << " at " << time;
    }
  }
  EXPECT_GT(crossings, 600);  // 965
}

// Against all spheres, one by one; some of them large, some outside their cells by as much as they may be.
TEST(Neighbors, whoReachesIntoABoxIsFoundThere) {
  Dice dice(5);
  std::size_t found = 0;
  for (int scene = 0; scene < 50; ++scene) {
    std::vector<Ball> all = balls(200, 4, static_cast<std::uint64_t>(scene));
    all[7].radius = 3;
    Neighbors grid = gridOf(all);
    for (std::size_t k = 0; k < all.size(); ++k) {
      grid.insert(static_cast<int>(k), all[k].position, all[k].radius);
      all[k].position += 0x1p-4 * grid.cellEdge() * dice.vector(1).cwiseSign();
    }
    for (int box = 0; box < 50; ++box) {
      const Vec3 low = dice.vector(5);
      const Vec3 high = low + dice.vector(0.5).cwiseAbs();
      std::vector<Neighbors::Key> within;
      grid.findWithin(low, high, within);
      EXPECT_TRUE(std::is_sorted(within.begin(), within.end()));
      EXPECT_EQ(std::adjacent_find(within.begin(), within.end()), within.end());
      for (std::size_t k = 0; k < all.size(); ++k) {
        const Vec3 nearest = all[k].position.cwiseMax(low).cwiseMin(high);
        if ((nearest - all[k].position).norm() <= all[k].radius) {
          EXPECT_TRUE(std::binary_search(within.begin(), within.end(), static_cast<int>(k)));
        }
      }
      found += within.size();
    }
  }
  EXPECT_LT(found, 50U * 50 * 60);  // of 200 each
}

// Without a grid, or in a box of more cells than bodies, all are.
TEST(Neighbors, allAreFoundInALargeBox) {
  const std::vector<Ball> all = balls(40, 4, 1);
  Neighbors grid = gridOf(all);
  for (std::size_t k = 0; k < all.size(); ++k) {
    grid.insert(static_cast<int>(k), all[k].position, all[k].radius);
  }
  std::vector<Neighbors::Key> within;
  grid.findWithin(Vec3::Constant(-1e60), Vec3::Constant(1e60), within);
  EXPECT_EQ(within.size(), 40U);
  grid.findWithin(Vec3::Constant(1e60), Vec3::Constant(-1e60), within);
  EXPECT_TRUE(within.empty());
  grid.findWithin(Vec3::Constant(-1e60), Vec3::Constant(1e60), within);
  EXPECT_TRUE(std::is_sorted(within.begin(), within.end()));
}

}  // namespace
}  // namespace careen
