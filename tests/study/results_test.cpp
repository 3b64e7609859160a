#include "study/results.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "some_case.h"

namespace careen {
namespace {

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

TEST(Results, ofAWholeStudyAreJson) {
  const StudyResult study{.machine = "here", .command = "careen study", .cases = {someCase()}};
  const nlohmann::json json = nlohmann::json::parse(resultsJson(study));
  EXPECT_EQ(json.at("machine"), "here");
  EXPECT_EQ(json.at("cases").at(0).at("attempts").size(), 4U);
  EXPECT_EQ(study.contestants(), (std::vector<std::string>{"exact", "strang", "ode"}));
}

// More energies than times would be read beyond the end of the times.
TEST(Results, whoseNumbersDoNotFitAreNone) {
  std::string text = encodeResult(someCase());
  text.replace(text.find("\"times\": ["), 10, "\"times\": [],\n \"other\": [");
  EXPECT_FALSE(decodeResult(text).has_value());
  text = encodeResult(someCase());
  text.replace(text.find("\"repeats\": 3"), 12, "\"repeats\": 1e60");
  ASSERT_TRUE(decodeResult(text).has_value());
  EXPECT_EQ(decodeResult(text)->attempts[0].repeats, 0);
}

}  // namespace
}  // namespace careen
