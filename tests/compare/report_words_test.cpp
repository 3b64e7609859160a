#include "compare/report_words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "comparisons.h"

namespace careen {
namespace {

Comparison comparisonOf(std::vector<FrameComparison> frames) {
  Comparison comparison;
  comparison.frames = std::move(frames);
  for (const FrameComparison& frame : comparison.frames) {
    comparison.verdict = std::max(comparison.verdict, frame.verdict);
  }
  return comparison;
}

FrameComparison nearlySame(const std::string& name, double largest) {
  FrameComparison frame = sameFrame(name);
  frame.identical = false;
  frame.largest = largest;
  return frame;
}

FrameComparison warned(const std::string& name) {
  FrameComparison frame = otherFrame(name, 0.01);
  frame.verdict = Verdict::kWarning;
  frame.reasons = {"near"};
  return frame;
}

TEST(ReportWords, nameVerdictsAndJoinReasons) {
  EXPECT_STREQ(nameOf(Verdict::kSame), "same");
  EXPECT_STREQ(nameOf(Verdict::kWarning), "warning");
  EXPECT_STREQ(nameOf(Verdict::kDifferent), "different");
  EXPECT_EQ(joined({}), "");
  EXPECT_EQ(joined({"one"}), "one");
  EXPECT_EQ(joined({"one", "two", "three"}), "one; two; three");
}

TEST(ReportWords, countFramesByWhatTheyCameTo) {
  FrameComparison missing = otherFrame("5", 0);
  missing.measured = false;
  const FrameCounts counts = countFrames(comparisonOf(
      {sameFrame("0"), sameFrame("1"), nearlySame("2", 0.001), warned("3"), otherFrame("4", 0.5), missing}));
  EXPECT_EQ(counts.same, 3U);
  EXPECT_EQ(counts.identical, 2U);
  EXPECT_EQ(counts.warning, 1U);
  EXPECT_EQ(counts.different, 2U);
  EXPECT_EQ(counts.notMeasured, 1U);
}

TEST(ReportWords, equalIsTheSameByteForByte) {
  EXPECT_TRUE(isEqual(comparisonOf({sameFrame("0"), sameFrame("1")})));
  EXPECT_FALSE(isEqual(comparisonOf({sameFrame("0"), nearlySame("1", 0.001)})));
  Comparison otherMotion = comparisonOf({sameFrame("0")});
  otherMotion.verdict = Verdict::kDifferent;
  EXPECT_FALSE(isEqual(otherMotion));
  Comparison runs = comparisonOf({});
  runs.run.emplace();
  EXPECT_FALSE(isEqual(runs));
  runs.run->sameBits = true;
  EXPECT_TRUE(isEqual(runs));
}

TEST(ReportWords, sayThatFilesAreTheSame) {
  EXPECT_EQ(reasonOf(comparisonOf({sameFrame("0")})), "The two files are the same, byte for byte.");
  EXPECT_EQ(reasonOf(comparisonOf({sameFrame("0"), sameFrame("1")})),
            "All 2 frames are the same, byte for byte.");
}

// 2/255 is the larger of the two.
TEST(ReportWords, sayByHowMuchFilesDifferWithinTheTolerance) {
  EXPECT_EQ(reasonOf(comparisonOf({nearlySame("0", 1 / 255.0)})),
            "The files differ, but within the tolerance: no channel differs by more than 1/255.");
  EXPECT_EQ(reasonOf(comparisonOf({sameFrame("0"), nearlySame("1", 2 / 255.0), nearlySame("2", 1 / 255.0)})),
            "The files differ, but within the tolerance: no channel differs by more than 2/255, the largest "
            "difference, in 1.");
}

TEST(ReportWords, nameTheFirstFrameThatDiffersAndTheWorst) {
  const std::string reason = "3 % of the pixels differ; at most 0.01 % may";
  EXPECT_EQ(reasonOf(comparisonOf({otherFrame("0", 0.5)})), "0: " + reason + ".");
  EXPECT_EQ(
      reasonOf(comparisonOf({sameFrame("0"), otherFrame("1", 0.25), otherFrame("2", 0.5)})),
      "2 frames of 3 beyond the tolerance. The first is 1: " + reason + ". The worst is 2: " + reason + ".");
  EXPECT_EQ(reasonOf(comparisonOf({sameFrame("0"), otherFrame("1", 0.5), otherFrame("2", 0.25)})),
            "2 frames of 3 beyond the tolerance. The first is 1: " + reason + ".");
  EXPECT_EQ(reasonOf(comparisonOf({sameFrame("0"), warned("1")})),
            "1 frame of 2 near the tolerance. The first is 1: near.");
}

std::string reasonOfRun(const RunDifference& run) {
  Comparison comparison;
  comparison.run = run;
  return reasonOf(comparison);
}

TEST(ReportWords, sayWhatRunsHaveInCommonAndWhatNot) {
  RunDifference run;
  run.incomparable = {"2 boxes and 3", "other names"};
  EXPECT_EQ(reasonOfRun(run), "The runs cannot be of the same scene: 2 boxes and 3; other names.");
  run = {};
  run.sameBits = true;
  EXPECT_EQ(reasonOfRun(run), "Every motion and every impact is the same, bit for bit.");
  run.until = 2.5;
  EXPECT_EQ(reasonOfRun(run), "Up to 2.5 s every motion and every impact is the same, bit for bit.");
  run = {};
  run.firstImpact.emplace();
  run.firstImpact->index = 6;
  run.firstImpact->what = "8.5 N s, not 8 N s";
  EXPECT_EQ(reasonOfRun(run), "The first impact that differs is number 7: 8.5 N s, not 8 N s.");
  run.firstTime = 0.5;
  run.worst.difference.relative = 0.125;
  EXPECT_EQ(reasonOfRun(run),
            "The first impact that differs is number 7: 8.5 N s, not 8 N s. States differ from 0.5 s on. "
            "Their largest difference is 0.125 half diagonals of a box, or radians.");
  run.firstImpact.reset();
  run.horizon = 4;
  EXPECT_TRUE(reasonOfRun(run).starts_with(
      "States differ from 0.5 s on. From 4 s on positions mean nothing any more, because"));
}

}  // namespace
}  // namespace careen
