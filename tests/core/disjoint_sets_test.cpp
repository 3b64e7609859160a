#include "core/disjoint_sets.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

TEST(DisjointSets, beginAlone) {
  DisjointSets sets(3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(sets.root(i), i);
  }
}

// By hand: 4–2 and 2–0 make {0, 2, 4}, 3–1 makes {1, 3}, whichever way round and in whatever order.
TEST(DisjointSets, goByTheirLeastMemberHoweverTheyWereJoined) {
  DisjointSets forward(5);
  forward.join(4, 2);
  forward.join(2, 0);
  forward.join(3, 1);
  DisjointSets backward(5);
  backward.join(1, 3);
  backward.join(0, 2);
  backward.join(2, 4);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(forward.root(i), i % 2) << i;
    EXPECT_EQ(backward.root(i), i % 2) << i;
  }
  forward.join(4, 3);
  EXPECT_EQ(forward.root(1), 0U);
  forward.reset(5);
  EXPECT_EQ(forward.root(4), 4U);
}

}  // namespace
}  // namespace careen
