#include "study/given_contestant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>

#include "core/system/file.h"
#include "core/system/scratch_folder.h"
#include "study/measuring.h"
#include "study/own_methods.h"
#include "support/given_tables.h"
#include "support/input_error.h"

namespace careen {
namespace {

std::string written(const ScratchFolder& folder, const std::string& text) {
  const std::filesystem::path path = folder / "theirs.csv";
  writeFile(path, text);
  return path.string();
}

// exact's own answer, as a table, has exact's error, in every kind of case that takes one run.
TEST(GivenContestant, hasTheErrorOfWhoMadeTheTable) {
  const ScratchFolder folder;
  const Contestants own = ownMethods();
  for (const char* const name :
       {"free-fall", "tumble-generic", "corner-impact", "sliding-spinning", "pile"}) {
    Case study = readCase(name);
    study.times.resize(std::min<std::size_t>(study.times.size(), 60));  // half of the pile's, to save time
    const Answer answer = answerOf(study, *own[0], study.scene.settings.tolerance, {});
    const auto given =
        givenContestant({.label = "theirs",
                         .file = written(folder, tableOf(study.world, study.times, answer.states)),
                         .seconds = 2},
                        study);
    EXPECT_EQ(given->name(), "theirs");
    EXPECT_EQ(given->settings().find("interpolated"), std::string::npos) << given->settings();
    EXPECT_NEAR(judge(study, answerOf(study, *given, 1, {})).error, judge(study, answer).error, 3e-15)
        << name;
  }
}

TEST(GivenContestant, isAskedOnceAndNotTimed) {
  const ScratchFolder folder;
  const Case study = readCase("free-fall");
  Contestants all = ownMethods();
  all.resize(1);
  const States states = answerOf(study, *all[0], study.scene.settings.tolerance, {}).states;
  const std::string file = written(folder, tableOf(study.world, study.times, states));
  all.push_back(givenContestant({.label = "unknown cost", .file = file, .seconds = {}}, study));
  all.push_back(givenContestant({.label = "known cost", .file = file, .seconds = 0.5}, study));
  const std::vector<Attempt> attempts = attemptAll(study, all, quickEffort(), {});
  ASSERT_GE(attempts.size(), 3U);
  const Attempt& unknown = attempts[attempts.size() - 2];
  EXPECT_EQ(unknown.contestant, "unknown cost");
  EXPECT_EQ(unknown.failure, "");
  EXPECT_EQ(unknown.cost, 0);
  EXPECT_EQ(unknown.dt, 0);
  EXPECT_EQ(attempts.back().cost, 5e5 / study.simulated());
  EXPECT_EQ(attempts.back().repeats, 0);
}

TEST(GivenContestant, tellsWhereItHadToInterpolate) {
  const ScratchFolder folder;
  const Case study = readCase("free-fall");
  const Contestants own = ownMethods();
  std::vector<double> times;
  for (int k = 1; k <= 7; ++k) {
    times.push_back(study.duration() * k / 7);
  }
  const States states = own[0]->run(study.world, study.scene.settings.tolerance, times, {});
  const auto given = givenContestant(
      {.label = "theirs", .file = written(folder, tableOf(study.world, times, states)), .seconds = {}},
      study);
  EXPECT_NE(given->settings().find("interpolated at "), std::string::npos) << given->settings();
}

TEST(GivenContestant, whatIsNoAnswerIsRefused) {
  const ScratchFolder folder;
  const Case study = readCase("free-fall");
  const Contestants own = ownMethods();
  const std::vector<double> half = {0.5 * study.duration()};
  const std::string file = written(
      folder, tableOf(study.world, half, own[0]->run(study.world, study.scene.settings.tolerance, half, {})));
  const auto refusalBy = [&](const Case& by) {
    return inputErrorOf([&] { givenContestant({.label = "theirs", .file = file, .seconds = {}}, by); });
  };
  EXPECT_NE(refusalBy(study).find("theirs.csv: ends at "), std::string::npos) << refusalBy(study);
  EXPECT_NE(refusalBy(readCase("reversal")).find("which takes two runs"), std::string::npos);
  EXPECT_NE(refusalBy(readCase("stack-10")).find("unknown box"), std::string::npos);
}

}  // namespace
}  // namespace careen
