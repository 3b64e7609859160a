#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "compare/report.h"
#include "comparisons.h"
#include "support/trajectories.h"

namespace careen {
namespace {

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

Comparison fourFrames() {
  Comparison comparison;
  comparison.expected = "reference";
  comparison.actual = "film";
  comparison.verdict = Verdict::kDifferent;
  comparison.headline = "other picture in 1 of 4 frames";
  comparison.frames = {sameFrame("a.png"), otherFrame("b.png", 0.5), otherFrame("c.png", 0.1), {}};
  comparison.frames[2].verdict = Verdict::kWarning;
  comparison.frames[2].reasons = {"nearly too much"};
  comparison.frames[3].name = "d.png";
  return comparison;
}

TEST(ReportJunit, hasACaseForEachFrameAndOneForTheWhole) {
  const std::string xml = reportJunit(fourFrames());
  EXPECT_TRUE(
      xml.starts_with("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"careen compare\" "
                      "tests=\"5\" failures=\"2\" errors=\"0\" skipped=\"0\">\n"
                      "  <testsuite name=\"film against reference\" tests=\"5\" failures=\"2\" "));
  EXPECT_EQ(count(xml, "<testcase "), 5);
  EXPECT_EQ(count(xml, "<failure "), 2);
  EXPECT_NE(
      xml.find("name=\"b.png\">\n      <failure type=\"different\" message=\"3 % of the pixels differ; at "
               "most 0.01 % may\">"),
      std::string::npos);
  EXPECT_NE(xml.find("name=\"c.png\">\n      <system-out>warning: nearly too much</system-out>"),
            std::string::npos);
  EXPECT_NE(xml.find("name=\"a.png\"/>"), std::string::npos);
  EXPECT_EQ(count(xml, "time="), 0);
}

TEST(ReportJunit, failsWhereOnlyTheWholeDiffers) {
  Comparison comparison = fourFrames();
  comparison.frames = {sameFrame("a.png")};
  comparison.headline = "other motion, same pictures";
  const std::string xml = reportJunit(comparison);
  EXPECT_EQ(count(xml, "<failure "), 1);
  EXPECT_NE(xml.find("message=\"other motion, same pictures."), std::string::npos);
  comparison.verdict = Verdict::kSame;
  EXPECT_EQ(count(reportJunit(comparison), "<failure "), 0);
}

TEST(ReportJunit, ofRunsHasACaseForEachProperty) {
  const Trajectory run = driftAndReturn();
  Trajectory other = run;
  other.impacts[0].impulse = 8.5;
  Comparison comparison = fourFrames();
  comparison.frames.clear();
  comparison.headline = "other motion";
  comparison.run = differenceOf(run, other);
  const std::string xml = reportJunit(comparison);
  EXPECT_EQ(count(xml, "<testcase classname=\"careen.compare.run\""), 5);
  EXPECT_EQ(count(xml, "<failure "), 2);
  EXPECT_NE(
      xml.find("name=\"impacts\">\n      <failure type=\"different\" message=\"at 0.5 s drifter against "
               "room+x with 8 N s: impulse by 0.5 N s\">"),
      std::string::npos);
  EXPECT_NE(xml.find("name=\"boxes\"/>"), std::string::npos);
  // Within a motion tolerance the same impact is no failure.
  comparison.verdict = Verdict::kSame;
  EXPECT_EQ(count(reportJunit(comparison), "<failure "), 0);
}

TEST(ReportJunit, hostileNamesAreEscaped) {
  Comparison comparison = fourFrames();
  comparison.frames[1].name = "<script>\"&'\x01\xFF.png";
  comparison.frames[1].reasons = {"]]> & <b>"};
  const std::string xml = reportJunit(comparison);
  EXPECT_NE(xml.find("name=\"&lt;script&gt;&quot;&amp;&#39;\uFFFD\uFFFD.png\""), std::string::npos);
  EXPECT_NE(xml.find(">]]&gt; &amp; &lt;b&gt;</failure>"), std::string::npos);
}

TEST(ReportJunit, comparisonThatEndedWithAnErrorIsOne) {
  const std::string xml = reportJunitOfError(fourFrames(), "no <memory>");
  EXPECT_NE(xml.find("tests=\"1\" failures=\"0\" errors=\"1\""), std::string::npos);
  EXPECT_NE(xml.find("name=\"film against reference\""), std::string::npos);
  EXPECT_EQ(count(xml, "<error type=\"not compared\" message=\"no &lt;memory&gt;\">"), 1);
  EXPECT_EQ(count(xml, "<failure "), 0);
}

TEST(ReportJunit, ignoredRegionsAreProperties) {
  Comparison comparison = fourFrames();
  EXPECT_EQ(count(reportJunit(comparison), "<property "), 1);
  comparison.ignored.add("1,2,3,4");
  EXPECT_EQ(count(reportJunit(comparison), "<property name=\"ignored\" value=\"1,2,3,4\"/>"), 1);
}

}  // namespace
}  // namespace careen
