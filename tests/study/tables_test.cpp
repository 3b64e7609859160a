// The tables that results.h declares.
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "some_case.h"

namespace careen {
namespace {

TEST(Tables, areTablesThatOtherProgramsRead) {
  const StudyResult study{.machine = "here", .command = "careen study", .cases = {someCase()}};
  EXPECT_EQ(resultsCsv(study),
            "case,contestant,dt,tolerance,error,cost_us,spread,repeats,front,failure,joint_gap\n"
            "tumble,exact,,1e-06,1e-15,0.1,0.1,3,1,,\n"
            "tumble,strang,0.2,,0.01,0.2,0.1,3,0,,\n"
            "tumble,strang,0.1,,0.0033333333333333335,0.4,0.1,3,0,,\n"
            "tumble,ode,0.1,,,,,,0,\"fell over, \"\"quietly\"\" and lay there\",\n");
  EXPECT_EQ(energyCsv(study),
            "case,contestant,time,change\n"
            "tumble,exact,1,1e-15\ntumble,exact,2,-1e-15\n"
            "tumble,strang,1,0.0033333333333333335\ntumble,strang,2,-0.0033333333333333335\n");
  EXPECT_EQ(matrixCsv(study),
            "row,column,case,contestant,digits,error\n"
            "0,0,tumble,exact,15,1e-15\n0,1,tumble,strang,2.477,0.0033\n0,2,tumble,ode,-1,–\n");
}

TEST(Tables, sayInWordsWhereExactIsBeaten) {
  StudyResult study{.machine = "here", .command = "careen study", .cases = {someCase()}};
  EXPECT_NE(resultsMarkdown(study).find("None."), std::string::npos);
  EXPECT_NE(resultsMarkdown(study).find("| tumble | 1e-15 | 0.0033 | – |"), std::string::npos);
  study.cases[0].attempts[1] = answered("strang", 0.2, 1e-16, 0.01);
  EXPECT_NE(resultsMarkdown(study).find("- tumble: exact has error 1e-15 at 0.1 µs/s; strang (dt 0.2) 1e-16"),
            std::string::npos);
  study.cases[0].attempts[0] = failed("exact", 0);
  EXPECT_NE(resultsMarkdown(study).find("- tumble: fell over"), std::string::npos);
}

// A message may hold whatever an engine says; a study of nothing is a table without rows.
TEST(Tables, ofNothingAreTheirHeads) {
  const StudyResult study{.machine = "here", .command = "careen study", .cases = {}};
  EXPECT_EQ(energyCsv(study), "case,contestant,time,change\n");
  EXPECT_EQ(matrixCsv(study), "row,column,case,contestant,digits,error\n");
  EXPECT_NE(resultsMarkdown(study).find("Made by `careen study` on here."), std::string::npos);
}

TEST(Tables, sayWhatIsSet) {
  StudyResult study{.machine = "here", .command = "careen study", .cases = {someCase(), someCase()}};
  for (CaseResult& result : study.cases) {
    result.attempts[1].settings = result.attempts[2].settings = "of order 2 | on time";
  }
  EXPECT_TRUE(resultsMarkdown(study).ends_with("| strang | of order 2 \\| on time |\n| ode |  |\n"))
      << resultsMarkdown(study);
}

TEST(Tables, giveErrorsWithTwoDigits) {
  EXPECT_EQ(inShort(0), "0");
  EXPECT_EQ(inShort(1.26e-15), "1.3e-15");
  EXPECT_EQ(inShort(0.99), "0.99");
}

TEST(Tables, holdNamesAsCells) {
  StudyResult study{.machine = "here", .command = "careen study", .cases = {someCase()}};
  study.cases[0].name = "=a,\"b\"\nc|d";
  EXPECT_NE(matrixCsv(study).find("\n0,0,\"'=a,\"\"b\"\" c|d\",exact,15,1e-15\n"), std::string::npos)
      << matrixCsv(study);
  EXPECT_NE(resultsCsv(study).find("\n\"'=a,\"\"b\"\" c|d\",exact,"), std::string::npos);
  EXPECT_NE(energyCsv(study).find("\n\"'=a,\"\"b\"\" c|d\",exact,"), std::string::npos);
  EXPECT_NE(resultsMarkdown(study).find("| =a,\"b\" c\\|d | 1e-15 |"), std::string::npos);
}

TEST(Tables, sayHowFarJointsAreOpenWhereThereAreAny) {
  StudyResult study{.machine = "here", .command = "careen study", .cases = {someCase()}};
  EXPECT_EQ(resultsMarkdown(study).find("## Joints"), std::string::npos);
  study.cases.push_back(someCase());
  study.cases[1].name = "pendulum";
  study.cases[1].attempts[0].judgement.jointGap = 2.5e-9;
  const std::string text = resultsMarkdown(study);
  const std::string table = text.substr(text.find("## Joints"));
  EXPECT_NE(table.find("| pendulum | 2.5e-09 | – | – |"), std::string::npos) << table;
  EXPECT_NE(resultsCsv(study).find("pendulum,exact,,1e-06,1e-15,0.1,0.1,3,1,,2.5e-09\n"), std::string::npos);
  const std::optional<CaseResult> back = decodeResult(encodeResult(study.cases[1]));
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->attempts[0].judgement.jointGap, 2.5e-9);
  EXPECT_FALSE(back->attempts[1].judgement.jointGap.has_value());
}

// What a contestant was never asked is not what it failed at.
TEST(Tables, leaveOutWhatWasNeverTried) {
  CaseResult other = someCase();
  other.name = "drop";
  other.attempts = {answered("bullet", 0.1, 0.5, 1)};
  const StudyResult study{.machine = "here", .command = "careen study", .cases = {someCase(), other}};
  EXPECT_NE(resultsMarkdown(study).find("| drop |  |  |  | 0.5 |"), std::string::npos);
  EXPECT_NE(matrixCsv(study).find("1,0,drop,exact,-1,\n"), std::string::npos);
}

}  // namespace
}  // namespace careen
