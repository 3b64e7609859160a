#include "exchange/mjcf_names.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

TEST(MjcfNames, areWithoutDoublesAndNotThoseOfARoomOrTheWorld) {
  MjcfNames names;
  EXPECT_EQ(names.unique("a", "box-0"), "a");
  EXPECT_EQ(names.unique("", "box-1"), "box-1");
  EXPECT_EQ(names.unique("a", "box-2"), "a-2");
  EXPECT_EQ(names.unique("a", "box-3"), "a-3");
  EXPECT_EQ(names.unique("room-x", "box-4"), "room-x-2");
  EXPECT_EQ(names.unique("world", "box-5"), "world-2");
  EXPECT_EQ(names.unique("b,\"c", "box-6"), "b__c");
  EXPECT_EQ(names.renamed(),
            "\"a\" is \"a-2\", \"a\" is \"a-3\", \"room-x\" is \"room-x-2\", "
            "\"world\" is \"world-2\", \"b,\"c\" is \"b__c\"");
}

}  // namespace
}  // namespace careen
