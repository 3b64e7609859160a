#include "core/csv.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

TEST(Csv, leavesAPlainNameAsItIs) {
  for (const char* const name : {"", "crate", "room+x", "-x", "+z", "a b", "it's", "1e-3"}) {
    EXPECT_EQ(csvCell(name), name);
  }
}

TEST(Csv, quotesWhatWouldEndACell) {
  EXPECT_EQ(csvCell("a,b"), "\"a,b\"");
  EXPECT_EQ(csvCell("a\"b"), "\"a\"\"b\"");
  EXPECT_EQ(csvCell("a\nb"), "\"a\nb\"");
}

TEST(Csv, keepsASpreadsheetFromRunningAName) {
  EXPECT_EQ(csvCell("=1+1"), "'=1+1");
  EXPECT_EQ(csvCell("@SUM(1)"), "'@SUM(1)");
  EXPECT_EQ(csvCell("-cmd|' /C calc'!A0"), "'-cmd|' /C calc'!A0");
  EXPECT_EQ(csvCell("\t=1"), "'\t=1");
  EXPECT_EQ(csvCell("=A1,B1"), "\"'=A1,B1\"");
}

}  // namespace
}  // namespace careen
