#include "physics/solver/elimination_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "physics/solver/contact_scene.h"

namespace careen {
namespace {

using Order = std::vector<std::size_t>;

ContactProblem graphOf(int bodies, const std::vector<std::pair<int, int>>& edges) {
  ContactScene scene;
  for (int body = 0; body < bodies; ++body) {
    scene.add(1, {1, 1, 1}, {}, {});
  }
  for (const auto& [a, b] : edges) {
    scene.touch(a, b, {}, 2, 1, 0);
  }
  return scene.problem;
}

TEST(EliminationOrder, leavesOfAStarComeFirst) {
  const Order order = eliminationOrder(graphOf(5, {{2, 0}, {2, 1}, {2, 3}, {2, 4}}));
  EXPECT_GE(std::find(order.begin(), order.end(), 2) - order.begin(), 3);  // the last leaf may follow it
}

// A chain is eliminated without fill: each body has one neighbour left at most.
TEST(EliminationOrder, chainHasNoFill) {
  const std::vector<std::pair<int, int>> chain{{5, 0}, {0, 3}, {3, 1}, {1, 4}, {4, 2}};
  std::vector<std::pair<int, int>> left = chain;
  for (const std::size_t body : eliminationOrder(graphOf(6, chain))) {
    const auto touches = [&](const std::pair<int, int>& edge) {
      return edge.first == static_cast<int>(body) || edge.second == static_cast<int>(body);
    };
    EXPECT_LE(std::count_if(left.begin(), left.end(), touches), 1);
    std::erase_if(left, touches);
  }
}

// Two bodies that only their masses, or only their speeds, or only their neighbours' neighbours tell apart.
TEST(EliminationOrder, doesNotFollowTheListing) {
  ContactProblem problem = graphOf(2, {{0, 1}});
  problem.inverseMass[0] = 0.5;
  EXPECT_EQ(eliminationOrder(problem), (Order{0, 1}));
  std::swap(problem.inverseMass[0], problem.inverseMass[6]);
  EXPECT_EQ(eliminationOrder(problem), (Order{1, 0}));
  problem = graphOf(2, {{0, 1}});
  problem.free[1] = -1;
  EXPECT_EQ(eliminationOrder(problem), (Order{1, 0}));
  problem.free[7] = 2;
  EXPECT_EQ(eliminationOrder(problem), (Order{0, 1}));
  // Body 0 of the first chain is body 4 of the second.
  const std::vector<std::pair<int, int>> edges{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {3, 4}};
  std::vector<std::pair<int, int>> reversed;
  for (const auto& [a, b] : edges) {
    reversed.emplace_back(4 - a, 4 - b);
  }
  Order order = eliminationOrder(graphOf(5, reversed));
  for (std::size_t& body : order) {
    body = 4 - body;
  }
  EXPECT_EQ(order, eliminationOrder(graphOf(5, edges)));
}

}  // namespace
}  // namespace careen
