#include "study/results.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace careen {
namespace {

Attempt answered(const std::string& contestant, double dt, double error, double cost) {
  Attempt attempt;
  attempt.contestant = contestant;
  attempt.settings = "as it is";
  attempt.dt = dt;
  attempt.judgement = {.error = error, .energy = {error, -error}};
  attempt.cost = cost;
  attempt.spread = 0.1;
  attempt.repeats = 3;
  return attempt;
}

Attempt failed(const std::string& contestant, double dt) {
  Attempt attempt;
  attempt.contestant = contestant;
  attempt.dt = dt;
  attempt.failure = "fell over, \"quietly\"\nand lay there";
  return attempt;
}

CaseResult someCase() {
  CaseResult result;
  result.name = "tumble";
  result.title = "A <tumble> & more";
  result.whyHard = "it tumbles";
  result.source = "closed form: none";
  result.measure = "energy";
  result.stamp = "0123456789abcdef";
  result.usualStep = 0.1;
  result.times = {1, 2};
  result.attempts = {answered("exact", 0, 1e-15, 0.1), answered("strang", 0.2, 1e-2, 0.2),
                     answered("strang", 0.1, 1. / 300, 0.4), failed("ode", 0.1)};
  result.attempts[0].tolerance = 1e-6;
  return result;
}

TEST(Results, comeBackFromTheirFileToTheBit) {
  const CaseResult result = someCase();
  const std::string text = encodeResult(result);
  const std::optional<CaseResult> back = decodeResult(text);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(encodeResult(*back), text);
  EXPECT_EQ(back->stamp, result.stamp);
  EXPECT_EQ(back->attempts[0].tolerance, 1e-6);
  EXPECT_EQ(back->attempts[2].judgement.error, 1. / 300);
  EXPECT_EQ(back->attempts[3].failure, result.attempts[3].failure);
  EXPECT_FALSE(decodeResult(text.substr(0, text.size() / 2)).has_value());
  EXPECT_FALSE(decodeResult("{}").has_value());
}

TEST(Results, findTheAttemptAtTheUsualStep) {
  const CaseResult result = someCase();
  EXPECT_EQ(usualAttempt(result, "exact"), &result.attempts[0]);
  EXPECT_EQ(usualAttempt(result, "strang"), &result.attempts[2]);
  EXPECT_EQ(usualAttempt(result, "ode"), &result.attempts[3]);
  EXPECT_EQ(usualAttempt(result, "bullet"), nullptr);
}

TEST(Results, areOnTheFrontUnlessAnotherIsBothCheaperAndBetter) {
  CaseResult result = someCase();
  EXPECT_TRUE(onFront(result, result.attempts[0]));
  EXPECT_FALSE(onFront(result, result.attempts[1]));
  EXPECT_FALSE(onFront(result, result.attempts[3]));
  EXPECT_TRUE(betterThan(result, result.attempts[0]).empty());
  ASSERT_EQ(betterThan(result, result.attempts[1]).size(), 1U);
  EXPECT_EQ(betterThan(result, result.attempts[1])[0], &result.attempts[0]);
  EXPECT_TRUE(betterThan(result, result.attempts[2]).size() == 1);
  result.attempts[1].cost = 0.01;  // cheaper, but less accurate
  EXPECT_TRUE(onFront(result, result.attempts[0]));
  EXPECT_TRUE(onFront(result, result.attempts[1]));
  result.attempts[2].judgement.error = 1e-16;  // more accurate, but more expensive
  EXPECT_TRUE(onFront(result, result.attempts[0]));
  result.attempts[2].cost = 0.009;
  EXPECT_FALSE(onFront(result, result.attempts[0]));
  // A contestant without an answer beats nobody.
  result.attempts[2].failure = "not finished";
  EXPECT_TRUE(onFront(result, result.attempts[0]));
}

TEST(Results, haveFromNoneToSixteenDigits) {
  EXPECT_EQ(correctDigits(0), 16);
  EXPECT_EQ(correctDigits(1e-20), 16);
  EXPECT_NEAR(correctDigits(1e-9), 9, 1e-12);
  EXPECT_EQ(correctDigits(30), 0);
  EXPECT_EQ(correctDigits(INFINITY), 0);
}

TEST(Results, areTablesThatOtherProgramsRead) {
  const StudyResult study{.machine = "here", .command = "careen study", .cases = {someCase()}};
  EXPECT_EQ(resultsCsv(study),
            "case,contestant,dt,tolerance,error,cost_us,spread,repeats,front,failure\n"
            "tumble,exact,,1e-06,1e-15,0.1,0.1,3,1,\n"
            "tumble,strang,0.2,,0.01,0.2,0.1,3,0,\n"
            "tumble,strang,0.1,,0.0033333333333333335,0.4,0.1,3,0,\n"
            "tumble,ode,0.1,,,,,,0,\"fell over, \"\"quietly\"\" and lay there\"\n");
  EXPECT_EQ(energyCsv(study),
            "case,contestant,time,change\n"
            "tumble,exact,1,1e-15\ntumble,exact,2,-1e-15\n"
            "tumble,strang,1,0.0033333333333333335\ntumble,strang,2,-0.0033333333333333335\n");
  EXPECT_EQ(matrixCsv(study),
            "row,column,case,contestant,digits,error\n"
            "0,0,tumble,exact,15,1e-15\n0,1,tumble,strang,2.477,0.0033\n0,2,tumble,ode,-1,–\n");
  const nlohmann::json json = nlohmann::json::parse(resultsJson(study));
  EXPECT_EQ(json.at("machine"), "here");
  EXPECT_EQ(json.at("cases").at(0).at("attempts").size(), 4U);
}

TEST(Results, sayInWordsWhereExactIsBeaten) {
  StudyResult study{.machine = "here", .command = "careen study", .cases = {someCase()}};
  EXPECT_NE(resultsMarkdown(study).find("None."), std::string::npos);
  EXPECT_NE(resultsMarkdown(study).find("| tumble | 1e-15 | 0.0033 | – |"), std::string::npos);
  study.cases[0].attempts[1] = answered("strang", 0.2, 1e-16, 0.01);
  EXPECT_NE(resultsMarkdown(study).find("- tumble: exact has error 1e-15 at 0.1 µs/s; strang (dt 0.2) 1e-16"),
            std::string::npos);
  study.cases[0].attempts[0] = failed("exact", 0);
  EXPECT_NE(resultsMarkdown(study).find("- tumble: fell over"), std::string::npos);
}

}  // namespace
}  // namespace careen
