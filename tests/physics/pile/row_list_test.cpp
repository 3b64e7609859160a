#include "physics/pile/row_list.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

// Two rows of one block, three of the next.
void expectTwoAndThree(const RowList& list) {
  ASSERT_EQ(list.blocks().size(), 2U);
  ASSERT_EQ(list.rows().size(), 5U);
  EXPECT_EQ(list.blocks()[0].first, 0);
  EXPECT_EQ(list.blocks()[0].count, 2);
  EXPECT_EQ(list.blocks()[1].first, 2);
  EXPECT_EQ(list.blocks()[1].count, 3);
  EXPECT_EQ(list.blocks()[1].a, 7);
  EXPECT_EQ(list.blocks()[1].friction, 0.5);
  for (int row = 0; row < 5; ++row) {
    EXPECT_EQ(list.blockOf(row), row < 2 ? 0 : 1);
    EXPECT_EQ(list.rows()[at(row)].bound, row);
  }
}

TEST(RowList, countsWhatIsAdded) {
  RowList list;
  list.begin({.a = 1, .b = 2});
  list.add({.bound = 9});
  list.clear();
  list.begin({.a = 3, .b = 4});
  list.add({.bound = 0});
  list.add({.bound = 1});
  list.begin({.a = 7, .b = 8, .friction = 0.5});
  list.add({.bound = 2});
  list.add({.bound = 3});
  list.add({.bound = 4});
  expectTwoAndThree(list);
}

TEST(RowList, takesWhatIsSetInAnyOrder) {
  RowList list;
  list.reserve({.blocks = 2, .rows = 5});
  for (const int row : {4, 0, 3, 2, 1}) {
    list.setRow(row, {.bound = static_cast<double>(row)});
  }
  list.setBlock(1, {.a = 7, .b = 8, .first = 2, .count = 3, .friction = 0.5});
  list.setBlock(0, {.a = 3, .b = 4, .first = 0, .count = 2});
  expectTwoAndThree(list);
}

}  // namespace
}  // namespace careen
