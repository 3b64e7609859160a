#include "study/study.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/system/file.h"
#include "study/own_methods.h"
#include "support/process.h"

namespace careen {
namespace {

class Study : public testing::Test {
 protected:
  StudySettings settings(std::vector<std::string> cases) const {
    return {
        .cases = std::move(cases),
        .effort =
            {.longestRun = 1, .longestStep = 0.1, .timing = 0, .rounds = 2, .shortest = 1e-5, .steps = {1}},
        .version = "1",
        .folder = folder_.path(),
        .resume = true};
  }
  // Names of the cases in the order of their callbacks, reused ones with a star.
  std::vector<std::string> run(const StudySettings& settings, const std::stop_token& stop = {}) {
    std::vector<std::string> reported;
    results_ = runStudy(
        settings, ownMethods(),
        [&](const CaseResult& result, bool takenOver) {
          reported.push_back(result.name + (takenOver ? "*" : ""));
        },
        stop);
    return reported;
  }

  TemporaryFolder folder_;
  std::vector<CaseResult> results_;
};
using Reported = std::vector<std::string>;

TEST_F(Study, takesOverWhatIsFinishedAndNothingElse) {
  StudySettings some = settings({"free-fall", "landing-flat"});
  EXPECT_EQ(run(some), (Reported{"free-fall", "landing-flat"}));
  const std::vector<CaseResult> first = results_;
  EXPECT_EQ(run(some), (Reported{"free-fall*", "landing-flat*"}));
  EXPECT_EQ(encodeResult(results_[1]), encodeResult(first[1]));
  // A truncated file is computed again, and so is one of another version or effort.
  writeFile(folder_ / "cases" / "free-fall.json", encodeResult(first[0]).substr(0, 100));
  EXPECT_EQ(run(some), (Reported{"free-fall", "landing-flat*"}));
  some.version = "2";
  EXPECT_EQ(run(some), (Reported{"free-fall", "landing-flat"}));
  some.effort.rounds = 3;
  EXPECT_EQ(run(some), (Reported{"free-fall", "landing-flat"}));
  some.resume = false;
  EXPECT_EQ(run(some), (Reported{"free-fall", "landing-flat"}));
}

TEST_F(Study, leavesWhatIsFinishedWhenInterrupted) {
  std::stop_source source;
  Reported reported;
  EXPECT_THROW(runStudy(
                   settings({"free-fall", "landing-flat"}), ownMethods(),
                   [&](const CaseResult& result, bool) {
                     reported.push_back(result.name);
                     source.request_stop();
                   },
                   source.get_token()),
               Interrupted);
  EXPECT_EQ(reported, (Reported{"free-fall"}));
  EXPECT_EQ(run(settings({"free-fall", "landing-flat"})), (Reported{"free-fall*", "landing-flat"}));
}

TEST_F(Study, takesASceneOfOnesOwnAgainstExact) {
  folder_.write("fall.json", R"({ "careen": 1, "name": "fall", "duration": 2, "gravity": [0, 0, -10],
    "room": { "min": [-2, -2, 0], "max": [2, 2, 4], "restitution": 1 },
    "boxes": [ { "half_extents": [0.3, 0.2, 0.1], "mass": 1, "position": [0, 0, 1], "angular_velocity": [1, 2, 3] } ] })");
  EXPECT_EQ(run(settings({(folder_ / "fall.json").string()})), (Reported{"fall"}));
  const Attempt& exact = *usualAttempt(results_[0], "exact");
  EXPECT_GT(exact.judgement.error, 1e-16);  // the possible error of exact itself
  EXPECT_LT(exact.judgement.error, 1e-8);   // measured 1.7e-10
  EXPECT_GT(usualAttempt(results_[0], "listing1")->judgement.error, 1e-3);
  EXPECT_LT(usualAttempt(results_[0], "taylor-8")->judgement.error, 1e-6);
}

TEST_F(Study, wantsDifferentNames) {
  folder_.write("free-fall.json",
                R"({ "careen": 1, "duration": 1, "boxes": [ { "half_extents": [1, 1, 1], "mass": 1 } ] })");
  EXPECT_THROW(run(settings({"free-fall", (folder_ / "free-fall.json").string()})), InputError);
}

TEST_F(Study, wantsNamesThatNoOtherPlotHas) {
  const std::string scene =
      R"({ "careen": 1, "duration": 1, "boxes": [ { "half_extents": [1, 1, 1], "mass": 1 } ] })";
  for (const char* const name : {"matrix.json", "room-minute-energy.json", "free-fall-energy.json"}) {
    folder_.write(name, scene);
  }
  const std::string energy = (folder_ / "room-minute-energy.json").string();
  for (const std::vector<std::string>& cases : {std::vector<std::string>{(folder_ / "matrix.json").string()},
                                                {"room-minute", energy},
                                                {energy, "room-minute"}}) {
    EXPECT_THROW(run(settings(cases)), InputError) << cases[0];
    EXPECT_FALSE(std::filesystem::exists(folder_ / "cases")) << "found before anything ran";
  }
  // Case free-fall measures poses: nothing else is called free-fall-energy.
  EXPECT_EQ(run(settings({"free-fall", (folder_ / "free-fall-energy.json").string()})),
            (Reported{"free-fall", "free-fall-energy"}));
}

}  // namespace
}  // namespace careen
