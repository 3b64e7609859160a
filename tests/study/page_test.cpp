// The page that study.h declares.
#include <gtest/gtest.h>

#include <string>

#include "some_case.h"
#include "study/study.h"

namespace careen {
namespace {

StudyResult someStudy() {
  return {.machine = "a <machine>", .command = "careen study tumble", .cases = {someCase()}};
}

TEST(StudyPage, holdsEverythingAndNeedsNoNetwork) {
  const std::string page = resultsPage(someStudy(), {"<?xml?><!DOCTYPE svg><svg id=\"plot\"></svg>"});
  for (const char* const part : {"a &lt;machine&gt;", "careen study tumble", "<svg id=\"plot\"></svg>",
                                 "id=\"tumble\"", "A &lt;tumble&gt; &amp; more", "it tumbles",
                                 "Truth: closed form: none.", "title=\"fell over, &quot;quietly&quot;",
                                 "<dt>strang</dt><dd>as it is</dd>", "<b>exact</b> answers 1 of 1 cases"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  for (const char* const part : {"http:", "https:", "{{", "<?xml", "src="}) {
    EXPECT_EQ(page.find(part), std::string::npos) << part;
  }
}

// 0 digits: red, rgb(178,24,43); 8: in the middle, rgb(247,247,247); 16: blue, rgb(67,147,195).
TEST(StudyPage, coloursAnAnswerByItsCorrectDigits) {
  StudyResult study = someStudy();
  study.cases[0].attempts = {answered("exact", 0, 0, 1), answered("half", 0.1, 1e-8, 1),
                             answered("none", 0.1, 7, 1)};
  const std::string page = resultsPage(study, {});
  EXPECT_NE(page.find("<td style=\"background:rgb(67,147,195)\">0</td>"), std::string::npos);
  EXPECT_NE(page.find("<td style=\"background:rgb(247,247,247)\">1e-08</td>"), std::string::npos);
  EXPECT_NE(page.find("<td style=\"background:rgb(178,24,43);color:white\">7</td>"), std::string::npos);
}

TEST(StudyPage, withoutPlotsHasTheTablesStill) {
  const std::string page = resultsPage(someStudy(), {});
  EXPECT_EQ(page.find("<svg"), std::string::npos);
  EXPECT_NE(page.find("<details><summary>All attempts</summary>"), std::string::npos);
}

}  // namespace
}  // namespace careen
