#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>

#include "compare/report.h"
#include "comparisons.h"
#include "support/process.h"

namespace careen {
namespace {

TEST(ReportPage, verdictAndFirstDifferenceComeBeforeAllElse) {
  const TemporaryFolder folder;
  const std::string page = reportPage(filmComparison(folder.path(), 6, 2, 4));
  const std::size_t verdict = page.find("✕ Different</p>");
  const std::size_t headline = page.find("<h1>other picture</h1>");
  const std::size_t first = page.find("4 frames of 6 beyond the tolerance. The first is 000002.png");
  ASSERT_NE(first, std::string::npos);
  EXPECT_LT(verdict, headline);
  EXPECT_LT(headline, first);
  EXPECT_LT(first, page.find("<main>"));
  EXPECT_NE(page.find("<th>scene hash</th><td class=\"other\">0123</td><td class=\"other\">4567</td>"
                      "<td class=\"other\">differs</td>"),
            std::string::npos);
}

TEST(ReportPage, asksTheNetworkForNothing) {
  const TemporaryFolder folder;
  const std::string page = reportPage(filmComparison(folder.path(), 4, 2, 3));
  const std::regex source(R"re((?:src|href)="([^"]*)")re");
  for (auto match = std::sregex_iterator(page.begin(), page.end(), source); match != std::sregex_iterator();
       ++match) {
    EXPECT_EQ((*match)[1], "data:,");
  }
  EXPECT_EQ(page.find("url("), std::string::npos);
  EXPECT_EQ(page.find("@import"), std::string::npos);
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(page.find("{{"), std::string::npos);
}

TEST(ReportPage, hostileNamesStayNames) {
  const TemporaryFolder folder;
  Comparison comparison = filmComparison(folder.path(), 3, 1, 2);
  const std::string name = "</script><script>alert(1)</script>\"'&{{style}}";
  comparison.headline = comparison.program = comparison.facts[0].name = comparison.frames[1].name = name;
  comparison.frames[1].reasons = {name};
  const std::string page = reportPage(comparison);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_NE(
      page.find("<h1>&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;&quot;&#39;&amp;{{style}}</h1>"),
      std::string::npos);
  EXPECT_NE(page.find(R"("\u003c/script>\u003cscript>alert(1)\u003c/script>\"'&{{style}}")"),
            std::string::npos);
}

TEST(ReportPage, ofEqualsIsShort) {
  const TemporaryFolder folder;
  const std::string page = reportPage(filmComparison(folder.path(), 5, 5, 5));
  EXPECT_NE(page.find("data-verdict=\"same\" data-equal=\"true\""), std::string::npos);
  EXPECT_NE(page.find("All 5 frames are the same, byte for byte."), std::string::npos);
  EXPECT_EQ(page.find("base64,"), std::string::npos);
}

TEST(ReportPage, ofRunsTellsTheHorizonAndTheImpacts) {
  const std::string page = reportPage(twoRuns());
  EXPECT_NE(page.find("The runs diverge at 0.5 s."), std::string::npos);
  EXPECT_NE(page.find("The horizon is at 0.50"), std::string::npos);
  EXPECT_NE(
      page.find("<th id=\"first-impact\">1 ← first</th><td>drifter against room+x</td><td>0.5</td><td>2</td>"
                "<td class=\"other\"><del>8</del> <ins>8.5</ins></td><td>0</td>"),
      std::string::npos);
  EXPECT_NE(page.find("<th>impacts</th><td>1</td><td>1</td><td>same</td>"), std::string::npos);
}

// Ten thousand frames, and pictures of twelve.
TEST(ReportPage, ofALongFilmIsNoLargerThanItsNumbersAndTwelveFrames) {
  const TemporaryFolder folder;
  Comparison comparison = filmComparison(folder.path(), 20, 3, 10);
  for (int k = 20; k < 10'000; ++k) {
    comparison.frames.push_back(otherFrame(frameName(k), 0.01));
  }
  const std::string page = reportPage(comparison);
  EXPECT_LT(page.size(), 6'000'000U);  // measured 4.1 MB
  EXPECT_NE(page.find("\"name\":\"009999.png\""), std::string::npos);
}

TEST(ReportPage, ignoredRegionsAreNamed) {
  const TemporaryFolder folder;
  Comparison comparison = filmComparison(folder.path(), 4, 2, 3);
  EXPECT_NE(reportPage(comparison).find("<div hidden><dt>ignored</dt>"), std::string::npos);
  comparison.ignored.add("1,2,3,4");
  comparison.ignored.add("5,6,7,8");
  EXPECT_NE(reportPage(comparison).find("<div ><dt>ignored</dt><dd>1,2,3,4; 5,6,7,8</dd></div>"),
            std::string::npos);
}

}  // namespace
}  // namespace careen
