#include <algorithm>
#include <string>
#include <vector>

#include "compare/report.h"
#include "compare/report_words.h"
#include "core/brief.h"
#include "core/characters.h"

namespace careen {
namespace {

/// One line in a CI system.
struct TestCase {
  std::string name;
  std::string failure;  ///< empty: it passed
  std::string warning;
  std::string error = {};  ///< it could not be tried
};

std::vector<TestCase> casesOfFrames(const Comparison& comparison) {
  std::vector<TestCase> cases;
  for (const FrameComparison& frame : comparison.frames) {
    const bool fails = frame.verdict == Verdict::kDifferent;
    const bool warns = frame.verdict == Verdict::kWarning;
    const std::string reasons = frame.reasons.empty() ? nameOf(frame.verdict) : joined(frame.reasons);
    cases.push_back({.name = frame.name, .failure = fails ? reasons : "", .warning = warns ? reasons : ""});
  }
  return cases;
}

std::string durationFailure(const RunDifference& run) {
  return run.until || run.actualDuration == run.expectedDuration
             ? ""
             : "found " + inFull(run.actualDuration) + " s, expected " + inFull(run.expectedDuration) + " s";
}

// Single properties fail only if the whole comparison does: within a tolerance they may differ.
std::vector<TestCase> casesOfRun(const Comparison& comparison, const RunDifference& run) {
  const auto failing = [&comparison](const std::string& what) {
    return comparison.verdict == Verdict::kDifferent ? what : std::string();
  };
  return {
      {.name = "boxes", .failure = failing(joined(run.incomparable)), .warning = {}},
      {.name = "duration", .failure = failing(durationFailure(run)), .warning = {}},
      {.name = "states",
       .failure = failing(run.firstTime ? "differs from " + brief(*run.firstTime) + " s on" : ""),
       .warning = {}},
      {.name = "impacts", .failure = failing(run.firstImpact ? run.firstImpact->what : ""), .warning = {}}};
}

// The verdict on the whole. Without it a difference that no single case has, such as another motion with the
// same pictures, would pass.
TestCase caseOfAll(const Comparison& comparison) {
  const std::string text = comparison.headline + ". " + reasonOf(comparison);
  return {.name = "verdict",
          .failure = comparison.verdict == Verdict::kDifferent ? text : "",
          .warning = comparison.verdict == Verdict::kWarning ? text : ""};
}

std::string xmlOf(const TestCase& test, const std::string& className) {
  const std::string head =
      "    <testcase classname=\"" + className + "\" name=\"" + escapedForMarkup(test.name) + "\"";
  const auto element = [&head](const std::string& tag, const std::string& type, const std::string& text) {
    const std::string message = escapedForMarkup(text);
    return head + ">\n      <" + tag + " type=\"" + type + "\" message=\"" + message + "\">" + message +
           "</" + tag + ">\n    </testcase>\n";
  };
  if (!test.error.empty()) {
    return element("error", "not compared", test.error);
  }
  if (!test.failure.empty()) {
    return element("failure", "different", test.failure);
  }
  if (!test.warning.empty()) {
    return head + ">\n      <system-out>" + escapedForMarkup("warning: " + test.warning) +
           "</system-out>\n    </testcase>\n";
  }
  return head + "/>\n";
}

std::string xmlOf(const std::vector<TestCase>& cases, const Comparison& comparison) {
  const auto counted = [&cases](std::string TestCase::*text) {
    return std::to_string(std::count_if(cases.begin(), cases.end(),
                                        [text](const TestCase& test) { return !(test.*text).empty(); }));
  };
  const std::string suite =
      escapedForMarkup(comparison.actual.string() + " against " + comparison.expected.string());
  const std::string className = comparison.run ? "careen.compare.run" : "careen.compare.frames";
  const std::string counts = " tests=\"" + std::to_string(cases.size()) + "\" failures=\"" +
                             counted(&TestCase::failure) + "\" errors=\"" + counted(&TestCase::error) +
                             R"(" skipped="0")";
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"careen compare\"" +
                    counts + ">\n  <testsuite name=\"" + suite + "\"" + counts + ">\n" +
                    R"(    <properties><property name="program" value=")" +
                    escapedForMarkup(comparison.program) + "\"/>";
  for (const std::string& region : comparison.ignored.names()) {
    xml += R"(<property name="ignored" value=")" + escapedForMarkup(region) + "\"/>";
  }
  xml += "</properties>\n";
  for (const TestCase& test : cases) {
    xml += xmlOf(test, className);
  }
  return xml + "  </testsuite>\n</testsuites>\n";
}

}  // namespace

std::string reportJunit(const Comparison& comparison) {
  std::vector<TestCase> cases = {caseOfAll(comparison)};
  const std::vector<TestCase> parts =
      comparison.run ? casesOfRun(comparison, *comparison.run) : casesOfFrames(comparison);
  cases.insert(cases.end(), parts.begin(), parts.end());
  return xmlOf(cases, comparison);
}

std::string reportJunitOfError(const Comparison& comparison, const std::string& error) {
  return xmlOf({TestCase{.name = "verdict", .failure = {}, .warning = {}, .error = error}}, comparison);
}

}  // namespace careen
