#include "study/verdicts.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "some_case.h"
#include "study/study.h"

namespace careen {
namespace {

TEST(Verdicts, areRightUpToATenthOfAHalfDiagonal) {
  EXPECT_EQ(verdictOf(nullptr), "–");
  const Attempt none = failed("ode", 0.1);
  EXPECT_EQ(verdictOf(&none), "–");
  Attempt attempt = answered("bullet", 0.1, 0.1, 1);
  EXPECT_EQ(verdictOf(&attempt), "right");
  attempt.judgement.error = 0.101;
  EXPECT_EQ(verdictOf(&attempt), "wrong");
}

// Tolerances in units of 1e-6.
Attempt exactAt(double factor, double sameTo, double displacement) {
  Attempt attempt = answered("exact", 0, 1, 1);
  attempt.tolerance = factor * 1e-6;
  attempt.sameTo = sameTo * 1e-6;
  attempt.judgement.displacement = displacement;
  return attempt;
}

TEST(Promises, areErrorsOverTheTolerancesAskedFor) {
  CaseResult result = someCase();
  result.attempts = {exactAt(1e2, 1e2, 3e-5), exactAt(1, 1e-2, 2e-7)};
  EXPECT_DOUBLE_EQ(promiseOf(result, 1e2).value(), 0.3);
  EXPECT_DOUBLE_EQ(promiseOf(result, 1).value(), 0.2);
  EXPECT_DOUBLE_EQ(promiseOf(result, 1e-2).value(), 20);  // the same bits as at 1e-6
  EXPECT_EQ(promiseOf(result, 1e-4), std::nullopt);       // never tried
  result.attempts = {exactAt(0, 1e-2, 1e-15)};
  EXPECT_DOUBLE_EQ(promiseOf(result, 1e-4).value(), 1e-5);
  result.attempts[0].judgement.displacement.reset();
  EXPECT_EQ(promiseOf(result, 1), std::nullopt);
}

TEST(Promises, andVerdictsAreInPageTableAndJson) {
  StudyResult study{.machine = "here", .command = "careen study", .cases = {someCase()}};
  CaseResult& result = study.cases[0];
  EXPECT_EQ(resultsMarkdown(study).find("published"), std::string::npos);
  result.published = "somebody & co";
  result.attempts = {exactAt(1e2, 1e2, 3e-5), exactAt(1, 1, 2e-6), answered("bullet", 0.1, 1e-3, 1),
                     failed("ode", 0.1)};
  result.attempts[1].judgement.error = 0.2;
  const std::string page = resultsPage(study, {});
  EXPECT_NE(page.find("<td>somebody &amp; co</td><td class=\"bad\">wrong</td><td>right</td><td>–</td>"),
            std::string::npos);
  EXPECT_NE(page.find("<td>0.3</td><td class=\"bad\">2</td><td>–</td><td>–</td>"), std::string::npos);
  const std::string table = resultsMarkdown(study);
  EXPECT_NE(table.find("| tumble | wrong | right | – |"), std::string::npos) << table;
  EXPECT_NE(table.find("- tumble: somebody & co"), std::string::npos) << table;
  EXPECT_NE(table.find("| tumble | 0.3 | **2** | – | – |"), std::string::npos) << table;
  const std::string json = resultsJson(study);
  for (const char* const part : {"\"published\": \"somebody & co\"", "\"exact\": \"wrong\"",
                                 "\"bullet\": \"right\"", "\"error_over_tolerance\": 2"}) {
    EXPECT_NE(json.find(part), std::string::npos) << part << '\n' << json;
  }
  // The file of a case brings all of it back.
  const std::optional<CaseResult> back = decodeResult(encodeResult(result));
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(encodeResult(*back), encodeResult(result));
  EXPECT_EQ(promiseOf(*back, 1e2), promiseOf(result, 1e2));
}

}  // namespace
}  // namespace careen
