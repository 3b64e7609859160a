#include "core/table.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

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

Table twoByTwo() {
  Table table{.head = {"name", "<unit>"}};
  TableCell link("a|b");
  link.section = "a&b";
  TableCell strong("1,5", R"(class="bad")");
  strong.isStrong = true;
  strong.replaced = "<2>";
  table.rows = {{link, strong}, {"two\nlines"}};
  return table;
}

TEST(Table, isWrittenAsCsv) { EXPECT_EQ(twoByTwo().csv(), "name,<unit>\na|b,\"1,5\"\ntwo lines\n"); }

TEST(Table, isWrittenAsMarkdown) {
  EXPECT_EQ(twoByTwo().markdown(), "| name | <unit> |\n|---|---|\n| a\\|b | **1,5** |\n| two lines |\n");
}

TEST(Table, isWrittenAsHtml) {
  const std::string rows =
      "<tr><th>name</th><th>&lt;unit&gt;</th></tr>\n"
      "<tr><th><a href=\"#a&amp;b\">a|b</a></th><td class=\"bad\"><del>&lt;2&gt;</del> "
      "<ins>1,5</ins></td></tr>\n"
      "<tr><th>two\nlines</th></tr>\n</table>\n";
  EXPECT_EQ(twoByTwo().html(), "<table>" + rows);
  EXPECT_EQ(twoByTwo().html("matrix"), "<table class=\"matrix\">\n" + rows);
}

TEST(CsvRow, numbersAreReadBackAsTheyWere) {
  CsvRow row;
  row.add(0.1).add("a,b").addAll(std::array{-1.0, 1e300, -std::nan("")});
  EXPECT_EQ(row.line(), "0.10000000000000001,\"a,b\",-1,1.0000000000000001e+300,nan\n");
  EXPECT_EQ(CsvRow().add("").add("").line(), ",\n");
}

}  // namespace
}  // namespace careen
